//! Text that ends up in comments and documentation of generated files.

/// Whether `letter` would end a comment's line, change the direction of what follows (which rustc refuses in comments), or
/// otherwise not be shown.
pub fn is_unprintable(letter: char) -> bool {
    letter.is_control()
        || matches!(letter, '\u{2028}' | '\u{2029}' | '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}')
}

/// `text` on one line, with a space for everything unprintable.
pub fn one_line(text: &str) -> String {
    text.chars().map(|letter| if is_unprintable(letter) { ' ' } else { letter }).collect()
}

#[cfg(test)]
mod tests {
    #[test]
    fn one_line_keeps_what_can_be_read() {
        assert_eq!(super::one_line("a\nb\r\tc\u{85}\u{2028}\u{202e}d\u{2066}"), "a b  c   d ");
        assert_eq!(
            super::one_line("(49), d' = J v, \u{e9}\u{3b1} \u{21a6}"),
            "(49), d' = J v, \u{e9}\u{3b1} \u{21a6}"
        );
    }
}
