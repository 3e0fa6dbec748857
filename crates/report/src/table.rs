//! Tables of text.

use maud::{Markup, Render, html};
use serde::Serialize;

/// Table with a row of column headings.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct Table {
    /// Column headings.
    pub head: Vec<String>,
    /// Cells by row.
    pub rows: Vec<Vec<String>>,
    /// True when all columns are aligned to the left, as suits words. Numbers are aligned to the
    /// right, except in the first column.
    #[serde(skip)]
    pub left_aligned: bool,
}

impl Table {
    /// Table of numbers.
    pub fn new(head: impl IntoIterator<Item = impl Into<String>>, rows: Vec<Vec<String>>) -> Self {
        Self { head: head.into_iter().map(Into::into).collect(), rows, left_aligned: false }
    }

    /// Table of words.
    pub fn of_words(head: impl IntoIterator<Item = impl Into<String>>, rows: Vec<Vec<String>>) -> Self {
        Self { left_aligned: true, ..Self::new(head, rows) }
    }
}

impl Render for Table {
    fn render(&self) -> Markup {
        html! {
            table.words[self.left_aligned] {
                thead { tr { @for cell in &self.head { th { (cell) } } } }
                tbody { @for row in &self.rows { tr { @for cell in row { td { (cell) } } } } }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_are_escaped() {
        let table = Table::new(["a & b"], vec![vec!["<1>".into()]]);
        let html = table.render().into_string();
        assert!(html.contains("<th>a &amp; b</th>") && html.contains("<td>&lt;1&gt;</td>"), "{html}");
    }
}
