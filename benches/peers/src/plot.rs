//! Cost against error as SVG with logarithmic axes, in the colour scheme of the reader's system.
//!
//! Drawn by hand: `plotters`, which draws the charts of `crates/report`, writes fixed colours into
//! the file and finds no free room for the names of points.

use std::fmt::Write as _;

use crate::report::{Report, Result};

const WIDTH: f64 = 820.0;
const HEIGHT: f64 = 520.0;
/// Frame of the plot: left, right, top, bottom.
const FRAME: [f64; 4] = [78.0, 790.0, 60.0, 455.0];
/// Approximate width of a letter of the labels.
const LETTER: f64 = 7.4;

const STYLE: &str = "
  svg { font: 13px system-ui, sans-serif }
  .ground { fill: #fff } text { fill: #222 } .faint { fill: #666 } .grid { stroke: #ddd } .frame { stroke: #888; fill: none }
  .Teeter { fill: #b3501b; stroke: #b3501b } .Rapier { fill: #2563a8; stroke: #2563a8 } .Box3D { fill: #2c7a4b; stroke: #2c7a4b }
  polyline { fill: none !important; stroke-width: 1.2; stroke-opacity: .5 }
  @media (prefers-color-scheme: dark) {
    .ground { fill: #16181c } text { fill: #e6e6e6 } .faint { fill: #a0a0a0 } .grid { stroke: #33363c } .frame { stroke: #777 }
    .Teeter { fill: #f08b4f; stroke: #f08b4f } .Rapier { fill: #6aa9ee; stroke: #6aa9ee } .Box3D { fill: #63c08a; stroke: #63c08a }
  }";

/// Logarithmic axis.
struct Axis {
    low: f64,
    high: f64,
    from: f64,
    to: f64,
}

impl Axis {
    /// Creates an axis from the last tick below all values to the first tick above them.
    fn around(values: impl Iterator<Item = f64> + Clone, from: f64, to: f64) -> Self {
        let (min, max) = (values.clone().fold(f64::INFINITY, f64::min), values.fold(0.0, f64::max));
        let low = ticks(1e-6, 1e6).filter(|t| *t < min * 0.9).last().unwrap_or(min);
        let high = ticks(1e-6, 1e6).find(|t| *t > max * 1.1).unwrap_or(max);
        Self { low, high, from, to }
    }

    /// Coordinate of a value.
    fn coordinate(&self, value: f64) -> f64 {
        self.from + (self.to - self.from) * (value / self.low).ln() / (self.high / self.low).ln()
    }
}

/// Returns 1, 2 and 5 times the powers of ten in a range.
fn ticks(low: f64, high: f64) -> impl Iterator<Item = f64> {
    let all = (-8..=8).flat_map(|e| [1.0, 2.0, 5.0].map(|m| format!("{m}e{e}").parse::<f64>().expect("a number")));
    all.filter(move |t| (low * 0.999..=high * 1.001).contains(t))
}

/// Formats the plot. Settings under which the tower fell are named below it.
pub fn svg(report: &Report) -> String {
    let [left, right, top, bottom] = FRAME;
    let shown: Vec<(&Result, f64, f64)> = report
        .results
        .iter()
        .filter(|r| r.stands)
        .filter_map(|r| Some((r, r.cpu_ms_per_s, r.mean_error().filter(|e| *e > 0.0)?)))
        .collect();
    let x = Axis::around(shown.iter().map(|p| p.1), left, right);
    let y = Axis::around(shown.iter().map(|p| p.2), bottom, top);
    let mut text = String::new();
    let mut line = |s: String| writeln!(text, "{s}").expect("writing to a string does not fail");
    line(format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {WIDTH} {HEIGHT}\" role=\"img\" aria-labelledby=\"title\">"
    ));
    line(format!("<title id=\"title\">Cost against error of {} settings of three engines</title>", shown.len()));
    line(format!("<style>{STYLE}\n</style>"));
    line(format!("<rect class=\"ground\" width=\"{WIDTH}\" height=\"{HEIGHT}\"/>"));
    line(format!(
        "<text x=\"{left}\" y=\"26\" font-size=\"16\">A full tower of 54 blocks, awake: what a second costs and how well it is seen</text>"
    ));
    line(format!("<text class=\"faint\" x=\"{left}\" y=\"46\">lower left is better</text>"));
    for t in ticks(x.low, x.high) {
        let at = x.coordinate(t);
        line(format!("<line class=\"grid\" x1=\"{at:.1}\" y1=\"{top}\" x2=\"{at:.1}\" y2=\"{bottom}\"/>"));
        line(format!("<text class=\"faint\" x=\"{at:.1}\" y=\"{}\" text-anchor=\"middle\">{t}</text>", bottom + 19.0));
    }
    for t in ticks(y.low, y.high) {
        let at = y.coordinate(t);
        line(format!("<line class=\"grid\" x1=\"{left}\" y1=\"{at:.1}\" x2=\"{right}\" y2=\"{at:.1}\"/>"));
        line(format!(
            "<text class=\"faint\" x=\"{}\" y=\"{:.1}\" text-anchor=\"end\">{t}</text>",
            left - 8.0,
            at + 4.0
        ));
    }
    line(format!(
        "<rect class=\"frame\" x=\"{left}\" y=\"{top}\" width=\"{}\" height=\"{}\"/>",
        right - left,
        bottom - top
    ));
    line(format!(
        "<text x=\"{}\" y=\"{}\" text-anchor=\"middle\">CPU time of one thread, ms per simulated second</text>",
        (left + right) / 2.0,
        bottom + 42.0
    ));
    let middle = (top + bottom) / 2.0;
    line(format!(
        "<text x=\"20\" y=\"{middle}\" text-anchor=\"middle\" transform=\"rotate(-90 20 {middle})\">mean error of the force that starts a block, N</text>"
    ));
    for engine in ["Teeter", "Rapier", "Box3D"] {
        let mut own: Vec<_> = shown.iter().filter(|(r, ..)| r.engine == engine && !r.setting.contains("f64")).collect();
        own.sort_by(|a, b| a.1.total_cmp(&b.1));
        let points: Vec<String> =
            own.iter().map(|p| format!("{:.1},{:.1}", x.coordinate(p.1), y.coordinate(p.2))).collect();
        line(format!("<polyline class=\"{engine}\" points=\"{}\"/>", points.join(" ")));
    }
    let marks: Vec<[f64; 4]> = shown.iter().map(|p| around(x.coordinate(p.1), y.coordinate(p.2), 6.0)).collect();
    let mut taken = marks.clone();
    for (r, cost, error) in &shown {
        let (px, py) = (x.coordinate(*cost), y.coordinate(*error));
        line(mark(&r.engine, px, py, r.setting.contains("f64")));
        let name = r.name();
        let length = LETTER * name.chars().count() as f64;
        // Right, left, above or below: the first that is free and inside of the frame.
        let boxes = [
            [px + 10.0, py - 9.0, px + 10.0 + length, py + 6.0],
            [px - 10.0 - length, py - 9.0, px - 10.0, py + 6.0],
            [px - length / 2.0, py - 26.0, px + length / 2.0, py - 10.0],
            [px - length / 2.0, py + 10.0, px + length / 2.0, py + 26.0],
        ];
        let free = |b: &&[f64; 4]| {
            b[0] > left && b[2] < right && b[1] > top && b[3] < bottom && !taken.iter().any(|t| meet(b, t))
        };
        let label = *boxes.iter().find(free).unwrap_or(&boxes[0]);
        line(format!("<text x=\"{:.1}\" y=\"{:.1}\">{name}</text>", label[0], label[3] - 3.0));
        taken.push(label);
    }
    let fallen: Vec<String> = report.results.iter().filter(|r| !r.stands).map(Result::name).collect();
    if !fallen.is_empty() {
        line(format!(
            "<text class=\"faint\" x=\"{left}\" y=\"{}\">not shown, the tower fell: {}</text>",
            HEIGHT - 8.0,
            fallen.join(", ")
        ));
    }
    line("</svg>".into());
    text
}

fn around(x: f64, y: f64, r: f64) -> [f64; 4] {
    [x - r, y - r, x + r, y + r]
}

fn meet(a: &[f64; 4], b: &[f64; 4]) -> bool {
    a[0] < b[2] && b[0] < a[2] && a[1] < b[3] && b[1] < a[3]
}

/// Mark of an engine. Shapes differ so that colour is not needed; f64 is hollow.
fn mark(engine: &str, x: f64, y: f64, hollow: bool) -> String {
    let fill = if hollow { " style=\"fill: none; stroke-width: 2\"" } else { "" };
    match engine {
        "Teeter" => format!("<circle class=\"{engine}\" cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"5.5\"{fill}/>"),
        "Rapier" => format!(
            "<rect class=\"{engine}\" x=\"{:.1}\" y=\"{:.1}\" width=\"10\" height=\"10\"{fill}/>",
            x - 5.0,
            y - 5.0
        ),
        _ => format!("<path class=\"{engine}\" d=\"M{:.1} {:.1}l6.5 11h-13z\"{fill}/>", x, y - 7.0),
    }
}
