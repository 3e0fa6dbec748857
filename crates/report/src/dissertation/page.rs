//! HTML: the page, tables and a chart.

use std::fmt::Write;

/// A part of the page.
#[derive(Debug, Clone)]
pub struct Section {
    /// Its heading.
    pub title: &'static str,
    /// What is under it.
    pub html: String,
}

/// The whole page.
pub fn page(sections: &[Section]) -> String {
    let style = "body{font:16px/1.5 system-ui,sans-serif;max-width:72em;margin:2em auto;padding:0 1em;color:#222}\
        table{border-collapse:collapse;margin:1em 0}th,td{border:1px solid #ccc;padding:.25em .6em;text-align:right;vertical-align:top}\
        th:first-child,td:first-child{text-align:left}thead{background:#f3f1ec}figure{display:inline-block;margin:.3em;vertical-align:top}\
        figcaption{font-size:13px;color:#555;max-width:220px}.words td,.words th{text-align:left}b{color:#b03020}svg text{font-size:12px}";
    let mut html = format!(
        "<!doctype html><html lang=\"en\"><meta charset=\"utf-8\"><meta name=\"viewport\" content=\"width=device-width\">\
         <title>The dissertation's results, again</title><style>{style}</style>\n<h1>The dissertation's results, again</h1>\n\
         <p>What chapter 6 of \"A Real-Time Physics Simulator for Jenga\" (Matthew South, 2003) shows, run again: the dissertation's own figure, the same by \
         its method written anew, and by the engine of Teeter. Lengths are in millimetres, times are those of one core.</p>\n\
         <p><i>2003 method</i> is the method as described; <i>2003 with 6.3</i> has what section 6.3 leaves for later, static friction and rest by the \
         motion of a whole block. <i>Lattice</i> and <i>rigid</i> are the engine, with blocks of eight particles and 28 springs, and with rigid ones.</p>\n"
    );
    for section in sections {
        let _ = write!(html, "<h2>{}</h2>\n{}\n", section.title, section.html);
    }
    html + "</html>\n"
}

/// A table; the first of each row is its heading.
pub fn table(head: &[&str], rows: &[Vec<String>]) -> String {
    table_of("", head, rows)
}

/// A table of words, aligned to the left.
pub fn table_of_words(head: &[&str], rows: &[Vec<String>]) -> String {
    table_of(" class=\"words\"", head, rows)
}

fn table_of(class: &str, head: &[&str], rows: &[Vec<String>]) -> String {
    let cells = |tag: &str, row: &mut dyn Iterator<Item = &str>| {
        row.map(|cell| format!("<{tag}>{cell}</{tag}>")).collect::<String>()
    };
    let body: String =
        rows.iter().map(|row| format!("<tr>{}</tr>\n", cells("td", &mut row.iter().map(String::as_str)))).collect();
    format!("<table{class}><thead><tr>{}</tr></thead>\n{body}</table>\n", cells("th", &mut head.iter().copied()))
}

/// A line of a chart.
pub struct Line<'a> {
    /// What it is called.
    pub name: &'a str,
    /// Its colour.
    pub colour: &'a str,
    /// Its points.
    pub points: Vec<(f64, f64)>,
}

/// A chart with a logarithmic scale upwards.
pub fn chart(lines: &[Line], x_name: &str, y_name: &str, marks: &[(f64, &str)]) -> String {
    let all = || lines.iter().flat_map(|l| &l.points);
    let most_x = all().map(|p| p.0).fold(1.0, f64::max);
    let lowest = all().map(|p| p.1).chain(marks.iter().map(|m| m.0)).fold(f64::INFINITY, f64::min);
    let highest = all().map(|p| p.1).fold(1.0, f64::max);
    let (low, high) = (libm::log10(lowest).floor(), libm::log10(highest).ceil());
    let x = |value: f64| 60.0 + 600.0 * value / most_x;
    let y = |value: f64| 330.0 - 310.0 * (libm::log10(value) - low) / (high - low);
    let mut svg = String::from("<svg viewBox=\"0 0 760 380\" width=\"760\" role=\"img\">");
    for power in low as i32..=high as i32 {
        let value = libm::pow(10.0, f64::from(power));
        let at = y(value);
        let _ = write!(
            svg,
            "<path d=\"M60 {at}H660\" stroke=\"#ddd\"/><text x=\"54\" y=\"{}\" text-anchor=\"end\">{value}</text>",
            at + 4.0
        );
    }
    for (value, name) in marks {
        let at = y(*value);
        let _ = write!(
            svg,
            "<path d=\"M60 {at}H660\" stroke=\"#999\" stroke-dasharray=\"4\"/><text x=\"664\" y=\"{}\">{name}</text>",
            at + 4.0
        );
    }
    for n in (0..=most_x as u32).step_by(3) {
        let _ = write!(svg, "<text x=\"{}\" y=\"348\" text-anchor=\"middle\">{n}</text>", x(f64::from(n)));
    }
    for (n, line) in lines.iter().enumerate() {
        let points: Vec<String> = line.points.iter().map(|p| format!("{:.1},{:.1}", x(p.0), y(p.1))).collect();
        let _ = write!(
            svg,
            "<polyline points=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"2\"/>",
            points.join(" "),
            line.colour
        );
        for p in &line.points {
            let _ = write!(svg, "<circle cx=\"{:.1}\" cy=\"{:.1}\" r=\"3\" fill=\"{}\"/>", x(p.0), y(p.1), line.colour);
        }
        let _ = write!(svg, "<text x=\"{}\" y=\"374\" fill=\"{}\">{}</text>", 60 + 140 * n, line.colour, line.name);
    }
    let _ = write!(
        svg,
        "<text x=\"660\" y=\"362\" text-anchor=\"end\">{x_name}</text><text x=\"8\" y=\"12\">{y_name}</text></svg>"
    );
    svg
}

/// A length in mm with what digits it needs.
pub fn mm(metres: f64) -> String {
    let mm = 1e3 * metres;
    if mm.abs() < 0.0005 {
        "0.000".into()
    } else if mm.abs() < 1.0 {
        format!("{mm:.3}")
    } else {
        format!("{mm:.1}")
    }
}
