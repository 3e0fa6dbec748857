//! Self-contained HTML pages.

use maud::{Markup, PreEscaped, html};

const STYLE: &str = "
body { font: 15px/1.5 system-ui, sans-serif; max-width: 68rem; margin: 2rem auto; padding: 0 1rem; color: #222 }
h2 { margin-top: 2.5rem; border-bottom: 1px solid #ddd }
table { border-collapse: collapse; margin: .8rem 0; font-variant-numeric: tabular-nums }
th, td { padding: .15rem .6rem; border-bottom: 1px solid #e4e4e4; text-align: right; vertical-align: top }
th:first-child, td:first-child, .words th, .words td { text-align: left }
thead { background: #f3f1ec }
.met { color: #237a36 } .missed { color: #b3261e; font-weight: bold }
.charts { display: flex; flex-wrap: wrap; gap: 1rem }
svg { max-width: 100%; height: auto }
figure { display: inline-block; margin: .3rem; vertical-align: top }
figcaption { font-size: 13px; color: #555; max-width: 220px }
";

/// Page with a heading, an introduction and sections. It loads nothing.
#[derive(Debug, Clone)]
pub struct Page {
    /// Heading and title.
    pub title: String,
    /// Content between the heading and the first section.
    pub introduction: Markup,
    /// Sections in order.
    pub sections: Vec<PageSection>,
}

/// Section of a page.
#[derive(Debug, Clone)]
pub struct PageSection {
    /// Target of links to the section.
    pub id: String,
    /// Heading.
    pub title: String,
    /// Content below the heading.
    pub content: Markup,
}

impl Page {
    /// Returns the page as HTML.
    pub fn html(&self) -> String {
        let page = html! {
            (PreEscaped("<!doctype html>"))
            html lang="en" {
                head {
                    meta charset="utf-8";
                    meta name="viewport" content="width=device-width";
                    title { (self.title) }
                    style { (PreEscaped(STYLE)) }
                }
                body {
                    h1 { (self.title) }
                    (self.introduction)
                    @for section in &self.sections {
                        section id=(section.id) { h2 { (section.title) } (section.content) }
                    }
                }
            }
        };
        page.into_string() + "\n"
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sections_are_targets_of_links_and_text_is_escaped() {
        let section = PageSection { id: "a".into(), title: "A & B".into(), content: html! { p { "<x>" } } };
        let page = Page { title: "T".into(), introduction: html! {}, sections: vec![section] }.html();
        assert!(page.starts_with("<!doctype html><html"), "{page}");
        assert!(page.contains("<section id=\"a\"><h2>A &amp; B</h2><p>&lt;x&gt;</p></section>"), "{page}");
    }
}
