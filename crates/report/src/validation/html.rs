//! The report as one page that needs nothing else.

use std::fmt::Write as _;

use teeter_scene::Form;

use super::plot::escaped;
use super::section::{Section, Size};

const STYLE: &str = "body{font:15px/1.5 system-ui,sans-serif;max-width:62rem;margin:2rem auto;padding:0 1rem;color:#222}\
h2{margin-top:2.5rem;border-bottom:1px solid #ddd}table{border-collapse:collapse;margin:.6rem 0;font-variant-numeric:tabular-nums}\
td,th{padding:.15rem .6rem;border-bottom:1px solid #eee;text-align:left}.ok{color:#237a36}.missed{color:#b3261e;font-weight:bold}\
.plots{display:flex;flex-wrap:wrap;gap:1rem}svg{width:28rem;max-width:100%;font:11px system-ui,sans-serif}.grid{stroke:#e6e6e6}\
.diagonal{stroke:#999;stroke-dasharray:4 3}";

/// The page.
pub fn page(size: &Size, sections: &[Section]) -> String {
    let mut page = format!(
        "<!doctype html><html lang=\"en\"><meta charset=\"utf-8\"><title>Teeter: validation</title><style>{STYLE}</style>"
    );
    let _ = write!(
        page,
        "<h1>Teeter: validation</h1><p>Version {}, {} towers of {} rows of each kind from seed {}, blocks {}{}. Nothing sleeps. All figures are in \
         <a href=\"validation.json\">validation.json</a>.</p>",
        env!("CARGO_PKG_VERSION"),
        size.towers,
        size.rows,
        size.seed,
        match size.form {
            Form::Rigid => "rigid",
            Form::Lattice => "of springs",
        },
        if size.quick { ", the small size that only shows that everything runs" } else { "" }
    );
    page += "<table><tr><th>what</th><th>measured</th><th>goal</th><th></th></tr>";
    for section in sections {
        for figure in section.figures.iter().filter(|f| f.met.is_some()) {
            let (class, word) = if figure.met == Some(true) { ("ok", "met") } else { ("missed", "missed") };
            let _ = write!(
                page,
                "<tr><td><a href=\"#{}\">{}</a></td><td>{}</td><td>{}</td><td class=\"{class}\">{word}</td></tr>",
                section.name,
                escaped(&figure.what),
                escaped(&figure.value),
                escaped(figure.goal.as_deref().unwrap_or_default())
            );
        }
    }
    page += "</table>";
    for section in sections {
        let _ = write!(
            page,
            "<h2 id=\"{}\">{}</h2><p>{}</p>",
            section.name,
            escaped(section.title),
            escaped(&section.method)
        );
        page += "<table>";
        for figure in &section.figures {
            let class = match figure.met {
                Some(true) => "ok",
                Some(false) => "missed",
                None => "",
            };
            let _ = write!(
                page,
                "<tr><td>{}</td><td class=\"{class}\">{}</td></tr>",
                escaped(&figure.what),
                escaped(&figure.value)
            );
        }
        page += "</table><div class=\"plots\">";
        section.plots.iter().for_each(|plot| page += &plot.svg());
        page += "</div>";
        for table in &section.tables {
            let cells = |row: &[String], tag: &str| {
                row.iter().map(|c| format!("<{tag}>{}</{tag}>", escaped(c))).collect::<String>()
            };
            let rows: String = table.rows.iter().map(|row| format!("<tr>{}</tr>", cells(row, "td"))).collect();
            let _ = write!(page, "<table><tr>{}</tr>{rows}</table>", cells(&table.head, "th"));
        }
    }
    page + "</html>\n"
}
