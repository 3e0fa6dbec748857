//! Plots as SVG: points and lines on axes, and nothing that a page would have to load.

use std::fmt::Write as _;

/// A plot.
#[derive(Debug, Clone, Default)]
pub struct Plot {
    /// Heading.
    pub title: String,
    /// What is along the axes.
    pub x: Axis,
    /// See `x`.
    pub y: Axis,
    /// What is drawn.
    pub series: Vec<Series>,
    /// Whether the line y = x is drawn.
    pub diagonal: bool,
}

/// An axis.
#[derive(Debug, Clone, Default)]
pub struct Axis {
    /// What it is, with its unit.
    pub label: String,
    /// Whether it is logarithmic; what is not above 0 is then left out.
    pub log: bool,
}

/// Points or a line.
#[derive(Debug, Clone, Default)]
pub struct Series {
    /// What they are.
    pub name: String,
    /// Places.
    pub points: Vec<(f64, f64)>,
    /// Whether they are joined.
    pub line: bool,
}

impl Axis {
    /// A linear one.
    pub fn new(label: &str) -> Self {
        Self { label: label.to_owned(), log: false }
    }

    /// A logarithmic one.
    pub fn log(label: &str) -> Self {
        Self { label: label.to_owned(), log: true }
    }

    fn scaled(&self, value: f64) -> Option<f64> {
        let scaled = if self.log { libm::log10(value) } else { value };
        scaled.is_finite().then_some(scaled)
    }

    /// From and to in scaled numbers, and the places of the ticks with their labels.
    fn range(&self, values: impl Iterator<Item = f64>) -> (f64, f64, Vec<(f64, String)>) {
        let (low, high) = values
            .filter_map(|v| self.scaled(v))
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), v| (l.min(v), h.max(v)));
        if low > high {
            return (0.0, 1.0, Vec::new());
        }
        let step = if self.log { (((high - low) / 6.0).ceil()).max(1.0) } else { step((high - low).max(1e-12)) };
        let (low, high) = ((low / step - 1e-9).floor() * step, (high / step + 1e-9).ceil() * step);
        let high = if high > low { high } else { low + step };
        let ticks = (0..=((high - low) / step).round() as usize).map(|i| low + step * i as f64);
        let label = |t: f64| if self.log { format!("1e{t}") } else { format!("{}", (t * 1e9).round() / 1e9) };
        (low, high, ticks.map(|t| (t, label(t))).collect())
    }
}

/// A step of 1, 2 or 5 times a power of ten that divides a length in about five.
fn step(length: f64) -> f64 {
    let raw = length / 5.0;
    let power = libm::pow(10.0, libm::floor(libm::log10(raw)));
    [1.0, 2.0, 5.0, 10.0].into_iter().map(|f| f * power).find(|s| *s >= raw * (1.0 - 1e-9)).unwrap_or(raw)
}

const WIDTH: f64 = 460.0;
const HEIGHT: f64 = 320.0;
const LEFT: f64 = 62.0;
const RIGHT: f64 = 12.0;
const TOP: f64 = 30.0;
const BOTTOM: f64 = 48.0;
/// Colours that differ in brightness as well.
const COLOURS: [&str; 6] = ["#1b6ca8", "#d1495b", "#3c9d4e", "#e09f3e", "#6a4c93", "#444444"];

impl Plot {
    /// The plot as an SVG element.
    pub fn svg(&self) -> String {
        let points = || self.series.iter().flat_map(|s| &s.points);
        let (x0, x1, x_ticks) = self.x.range(points().map(|p| p.0));
        let (y0, y1, y_ticks) = self.y.range(points().map(|p| p.1));
        let across = |x: f64| LEFT + (x - x0) / (x1 - x0) * (WIDTH - LEFT - RIGHT);
        let up = |y: f64| HEIGHT - BOTTOM - (y - y0) / (y1 - y0) * (HEIGHT - TOP - BOTTOM);
        let mut svg =
            format!("<svg viewBox=\"0 0 {WIDTH} {HEIGHT}\" role=\"img\"><title>{0}</title>", escaped(&self.title));
        let mut text = |x: f64, y: f64, anchor: &str, extra: &str, words: &str| {
            let _ = write!(
                svg,
                "<text x=\"{x:.1}\" y=\"{y:.1}\" text-anchor=\"{anchor}\"{extra}>{}</text>",
                escaped(words)
            );
        };
        text(WIDTH / 2.0, 16.0, "middle", " font-weight=\"bold\"", &self.title);
        text((LEFT + WIDTH - RIGHT) / 2.0, HEIGHT - 10.0, "middle", "", &self.x.label);
        let middle = (TOP + HEIGHT - BOTTOM) / 2.0;
        text(14.0, middle, "middle", &format!(" transform=\"rotate(-90 14 {middle})\""), &self.y.label);
        for (t, label) in &x_ticks {
            text(across(*t), HEIGHT - BOTTOM + 15.0, "middle", "", label);
        }
        for (t, label) in &y_ticks {
            text(LEFT - 5.0, up(*t) + 4.0, "end", "", label);
        }
        for (i, series) in self.series.iter().enumerate().filter(|_| self.series.len() > 1) {
            let fill = format!(" fill=\"{}\"", COLOURS[i % COLOURS.len()]);
            text(LEFT + 8.0, TOP + 14.0 + 14.0 * i as f64, "start", &fill, &series.name);
        }
        let mut line = |x0: f64, y0: f64, x1: f64, y1: f64, class: &str| {
            let _ =
                write!(svg, "<line x1=\"{x0:.1}\" y1=\"{y0:.1}\" x2=\"{x1:.1}\" y2=\"{y1:.1}\" class=\"{class}\"/>");
        };
        x_ticks.iter().for_each(|(t, _)| line(across(*t), TOP, across(*t), HEIGHT - BOTTOM, "grid"));
        y_ticks.iter().for_each(|(t, _)| line(LEFT, up(*t), WIDTH - RIGHT, up(*t), "grid"));
        if self.diagonal {
            let (low, high) = (x0.max(y0), x1.min(y1));
            line(across(low), up(low), across(high), up(high), "diagonal");
        }
        for (i, series) in self.series.iter().enumerate() {
            let colour = COLOURS[i % COLOURS.len()];
            let place = |&(x, y): &(f64, f64)| Some((across(self.x.scaled(x)?), up(self.y.scaled(y)?)));
            let places: Vec<(f64, f64)> = series.points.iter().filter_map(place).collect();
            if series.line {
                let path: Vec<String> = places.iter().map(|(x, y)| format!("{x:.1},{y:.1}")).collect();
                let _ = write!(
                    svg,
                    "<polyline points=\"{}\" fill=\"none\" stroke=\"{colour}\" stroke-width=\"1.5\"/>",
                    path.join(" ")
                );
            }
            for (x, y) in places {
                let _ = write!(
                    svg,
                    "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"2.2\" fill=\"{colour}\" fill-opacity=\"0.6\"/>"
                );
            }
        }
        svg + "</svg>"
    }
}

/// Text for a page.
pub fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_are_round_and_hold_all_values() {
        let (low, high, ticks) = Axis::new("x").range([0.13, 3.7].into_iter());
        assert_eq!((low, high), (0.0, 4.0));
        assert_eq!(ticks.iter().map(|t| t.1.as_str()).collect::<Vec<_>>(), ["0", "1", "2", "3", "4"]);
        let (low, high, ticks) = Axis::log("x").range([3e-4, 20.0, 0.0].into_iter());
        assert_eq!((low, high, ticks[0].1.as_str()), (-4.0, 2.0, "1e-4"));
        // all alike, and none
        let (low, high, _) = Axis::new("x").range([2.0].into_iter());
        assert!(low < high);
        assert_eq!(Axis::new("x").range(std::iter::empty()).2.len(), 0);
    }

    #[test]
    fn every_point_is_drawn_once_and_text_is_escaped() {
        let series = Series { name: "a".into(), points: vec![(1.0, 2.0), (2.0, f64::NAN), (3.0, 5.0)], line: true };
        let plot = Plot {
            title: "<b> & c".into(),
            x: Axis::new("x"),
            y: Axis::new("y"),
            series: vec![series],
            diagonal: true,
        };
        let svg = plot.svg();
        assert_eq!(svg.matches("<circle").count(), 2);
        assert!(svg.contains("&lt;b&gt; &amp; c") && svg.ends_with("</svg>"));
    }
}
