//! Self-contained HTML pages.

use maud::{Markup, PreEscaped, html};

/// Program and version that wrote a page. Sections of another version are not kept: their figures
/// may not be comparable.
const GENERATOR: &str = concat!("<meta name=\"generator\" content=\"teeter ", env!("CARGO_PKG_VERSION"), "\">");
/// Note below the heading of a section of an earlier run.
const EARLIER_RUN: &str = "<p class=\"kept\">From an earlier run.</p>";

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
.kept { color: #555; font-style: italic }
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
    /// True for the result of an earlier run.
    pub kept: bool,
}

impl PageSection {
    /// Section of this run.
    pub fn new(id: &str, title: &str, content: Markup) -> Self {
        Self { id: id.to_owned(), title: title.to_owned(), content, kept: false }
    }

    /// Returns the sections of a page (HTML) that this version wrote; none for any other text.
    pub fn kept_from(page: &str) -> Vec<Self> {
        if !page.contains(GENERATOR) {
            return Vec::new();
        }
        page.split("<section id=\"").skip(1).filter_map(Self::parse).collect()
    }

    /// Parses the text of a section from behind the quote that opens its id.
    fn parse(text: &str) -> Option<Self> {
        let (id, rest) = text.split_once("\"><h2>")?;
        let (title, rest) = rest.split_once("</h2>")?;
        let (content, _) = rest.split_once("</section>")?;
        let content = PreEscaped(content.strip_prefix(EARLIER_RUN).unwrap_or(content).to_owned());
        Some(Self { id: id.to_owned(), title: unescape(title), content, kept: true })
    }
}

/// Reverses the escapes of text in HTML.
fn unescape(text: &str) -> String {
    text.replace("&lt;", "<").replace("&gt;", ">").replace("&quot;", "\"").replace("&amp;", "&")
}

impl Page {
    /// Returns the page as HTML.
    pub fn html(&self) -> String {
        let page = html! {
            (PreEscaped("<!doctype html>"))
            html lang="en" {
                head {
                    meta charset="utf-8";
                    (PreEscaped(GENERATOR))
                    meta name="viewport" content="width=device-width";
                    title { (self.title) }
                    style { (PreEscaped(STYLE)) }
                }
                body {
                    h1 { (self.title) }
                    (self.introduction)
                    @for section in &self.sections {
                        section id=(section.id) {
                            h2 { (section.title) }
                            @if section.kept { (PreEscaped(EARLIER_RUN)) }
                            (section.content)
                        }
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
        let section = PageSection::new("a", "A & B", html! { p { "<x>" } });
        let page = Page { title: "T".into(), introduction: html! {}, sections: vec![section] }.html();
        assert!(page.starts_with("<!doctype html><html"), "{page}");
        assert!(page.contains("<section id=\"a\"><h2>A &amp; B</h2><p>&lt;x&gt;</p></section>"), "{page}");
    }

    #[test]
    fn sections_are_read_from_a_page_as_they_were_written() {
        let section = |id, title, text: &str| PageSection::new(id, title, html! { p { (text) } });
        let sections = vec![section("a", "A & B", "<x>"), section("b", "\"B\"", "y")];
        let page = Page { title: "T".into(), introduction: html! {}, sections: sections.clone() }.html();
        let read = PageSection::kept_from(&page);
        for (read, written) in read.iter().zip(&sections) {
            assert_eq!((&read.id, &read.title), (&written.id, &written.title));
            assert_eq!(read.content.clone().into_string(), written.content.clone().into_string());
        }
        assert_eq!((read.len(), read.iter().all(|section| section.kept)), (2, true));
        // The mark of an earlier run does not pile up.
        let again = Page { title: "T".into(), introduction: html! {}, sections: read }.html();
        assert_eq!(again.matches("earlier run").count(), 2);
        let twice = Page { title: "T".into(), introduction: html! {}, sections: PageSection::kept_from(&again) }.html();
        assert_eq!(twice, again);
    }

    #[test]
    fn no_section_is_kept_from_another_text() {
        assert!(PageSection::kept_from("<section id=\"a\"><h2>A</h2></section>").is_empty());
        assert!(PageSection::kept_from("").is_empty());
    }
}
