//! Tables as text, columns as wide as needed, and in Markdown: the first columns to the left, numbers to the right.

/// Lines of a table; the first of `left` columns are flush left, all others flush right.
pub fn text(heading: &[&str], rows: &[Vec<String>], left: usize) -> String {
    let cells = |column: usize| rows.iter().map(move |row| row[column].chars().count());
    let widths: Vec<usize> = (0..heading.len())
        .map(|column| cells(column).chain([heading[column].chars().count()]).max().unwrap_or(0))
        .collect();
    let heading: Vec<String> = heading.iter().map(|cell| cell.to_string()).collect();
    let line = |row: &Vec<String>| {
        let padded = row.iter().zip(&widths).enumerate().map(|(column, (cell, width))| {
            if column < left { format!("{cell:<width$}") } else { format!("{cell:>width$}") }
        });
        padded.collect::<Vec<_>>().join("  ").trim_end().to_owned() + "\n"
    };
    std::iter::once(&heading).chain(rows).map(line).collect()
}

/// The same in Markdown.
pub fn markdown(heading: &[&str], rows: &[Vec<String>], left: usize) -> String {
    let line = |cells: &[String]| format!("| {} |\n", cells.join(" | "));
    let heading: Vec<String> = heading.iter().map(|cell| cell.to_string()).collect();
    let alignment = (0..heading.len()).map(|column| if column < left { "-" } else { "-:" }.to_owned());
    let alignment: Vec<String> = alignment.collect();
    let rows = rows.iter().map(|row| line(row));
    [line(&heading), format!("|{}|\n", alignment.join("|"))].into_iter().chain(rows).collect()
}

#[cfg(test)]
mod tests {
    #[test]
    fn markdown_aligns_numbers() {
        let rows = [vec!["a".to_owned(), "1".to_owned()]];
        assert_eq!(super::markdown(&["of", "n"], &rows, 1), "| of | n |\n|-|-:|\n| a | 1 |\n");
    }

    #[test]
    fn columns_line_up() {
        let rows = [vec!["a".to_owned(), "1".to_owned()], vec!["long".to_owned(), "22".to_owned()]];
        assert_eq!(super::text(&["of", "n"], &rows, 1), "of     n\na      1\nlong  22\n");
    }
}
