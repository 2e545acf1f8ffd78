//! A command line as one line of text, and back.

/// `words` as one would type them in a shell.
pub fn joined(words: &[String]) -> String {
    words.iter().map(|word| quoted(word)).collect::<Vec<_>>().join(" ")
}

fn quoted(word: &str) -> String {
    let is_plain = |letter: char| letter.is_alphanumeric() || "_-./,:=+@%".contains(letter);
    if !word.is_empty() && word.chars().all(is_plain) {
        word.to_owned()
    } else {
        format!("'{}'", word.replace('\'', r"'\''"))
    }
}

/// The words of a line that [`joined`] made; none for a quote without end.
pub fn split(line: &str) -> Option<Vec<String>> {
    let mut words = Vec::new();
    let mut word: Option<String> = None;
    let mut letters = line.chars();
    while let Some(letter) = letters.next() {
        match letter {
            ' ' => words.extend(word.take()),
            '\'' => {
                let word = word.get_or_insert_default();
                loop {
                    match letters.next()? {
                        '\'' => break,
                        letter => word.push(letter),
                    }
                }
            }
            '\\' => word.get_or_insert_default().push(letters.next()?),
            letter => word.get_or_insert_default().push(letter),
        }
    }
    words.extend(word);
    Some(words)
}

#[cfg(test)]
mod tests {
    use super::{joined, split};

    #[test]
    fn a_line_gives_its_words_back() {
        let words = ["a", "my platform.toml", "it's", "", "--x=1", "\u{3b1}", "a\\b", "$HOME"];
        let words = words.map(str::to_owned).to_vec();
        assert_eq!(joined(&words[..4]), r"a 'my platform.toml' 'it'\''s' ''");
        assert_eq!(split(&joined(&words)), Some(words));
        assert_eq!(split("a 'b"), None);
        assert_eq!(split("  a   b "), Some(vec!["a".into(), "b".into()]));
    }
}
