//! Text tables: columns as wide as needed, the first ones to the left, numbers to the right.

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

#[cfg(test)]
mod tests {
    #[test]
    fn columns_line_up() {
        let rows = [vec!["a".to_owned(), "1".to_owned()], vec!["long".to_owned(), "22".to_owned()]];
        assert_eq!(super::text(&["of", "n"], &rows, 1), "of     n\na      1\nlong  22\n");
    }
}
