//! Charts as SVG: series of points and lines on linear or logarithmic axes.

mod axis;

use maud::{Markup, PreEscaped, Render};
use plotters::coord::Shift;
use plotters::coord::ranged1d::Ranged;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use axis::Coordinate;
pub use axis::{Axis, Scale};

/// Size of a chart, pixels.
const SIZE: (u32, u32) = (480, 340);
/// Colours that differ in brightness as well as in hue.
const COLORS: [RGBColor; 6] = [
    RGBColor(0x1b, 0x6c, 0xa8),
    RGBColor(0xd1, 0x49, 0x5b),
    RGBColor(0x3c, 0x9d, 0x4e),
    RGBColor(0xe0, 0x9f, 0x3e),
    RGBColor(0x6a, 0x4c, 0x93),
    RGBColor(0x44, 0x44, 0x44),
];
const TEXT: RGBColor = RGBColor(0x33, 0x33, 0x33);
const GRID: RGBColor = RGBColor(0xe4, 0xe4, 0xe4);
const REFERENCE: RGBColor = RGBColor(0x99, 0x99, 0x99);
const FONT: &str = "system-ui, sans-serif";
/// Font size of labels, pixels of the font's bounding box: the em is four fifths of it.
const TEXT_SIZE: i32 = 14;
/// Font size of the heading, pixels of the font's bounding box.
const TITLE_SIZE: i32 = 17;

/// Chart of one or more series.
#[derive(Debug, Clone, Default)]
pub struct Chart {
    /// Heading.
    pub title: String,
    /// Horizontal axis.
    pub x: Axis,
    /// Vertical axis.
    pub y: Axis,
    /// Series in the order of the legend.
    pub series: Vec<Series>,
    /// True when the line y = x is drawn.
    pub diagonal: bool,
    /// Dashed horizontal lines with their labels.
    pub goals: Vec<(f64, String)>,
}

/// Series of points.
#[derive(Debug, Clone, Default)]
pub struct Series {
    /// Name in the legend; a chart without a named series has no legend.
    pub name: String,
    /// Points (x, y). Those that are not finite, or not positive on a logarithmic axis, are not
    /// drawn.
    pub points: Vec<(f64, f64)>,
    /// True when a line joins the points.
    pub joined: bool,
}

impl Series {
    /// Points joined by a line.
    pub fn line(name: &str, points: Vec<(f64, f64)>) -> Self {
        Self { name: name.to_owned(), points, joined: true }
    }

    /// Separate points.
    pub fn points(name: &str, points: Vec<(f64, f64)>) -> Self {
        Self { name: name.to_owned(), points, joined: false }
    }
}

type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;
type Drawn<'a, 'b> = ChartContext<'a, SVGBackend<'b>, Cartesian2d<Coordinate, Coordinate>>;

impl Chart {
    /// Returns the chart as an SVG element.
    pub fn svg(&self) -> String {
        let mut svg = String::new();
        {
            let area = SVGBackend::with_string(&mut svg, SIZE).into_drawing_area();
            self.draw(&area).expect("drawing into memory does not fail");
        }
        // Without the XML declaration, which HTML does not admit.
        svg.find("<svg").map_or(svg.clone(), |start| svg[start..].to_owned())
    }

    fn draw(&self, area: &Area) -> Result<(), Box<dyn std::error::Error>> {
        let points = || self.series.iter().flat_map(|series| &series.points).copied().filter(|&p| self.is_visible(p));
        let x = self.x.coordinate(points().map(|p| p.0));
        let y = self.y.coordinate(points().map(|p| p.1).chain(self.goals.iter().map(|goal| goal.0)));
        let legend = self.legend_position(&x, &y);
        let mut chart = ChartBuilder::on(area)
            .caption(&self.title, (FONT, TITLE_SIZE, FontStyle::Bold, &TEXT))
            .margin(8)
            .margin_right(16)
            .x_label_area_size(44)
            .y_label_area_size(64)
            .build_cartesian_2d(x, y)?;
        chart
            .configure_mesh()
            .x_desc(&self.x.label)
            .y_desc(&self.y.label)
            .x_labels(8)
            .y_labels(8)
            .label_style((FONT, TEXT_SIZE, &TEXT))
            .axis_style(REFERENCE)
            .bold_line_style(GRID)
            .max_light_lines(0)
            .draw()?;
        self.draw_references(&mut chart)?;
        for (series, color) in self.series.iter().zip(COLORS.into_iter().cycle()) {
            self.draw_series(&mut chart, series, color)?;
        }
        if self.series.iter().any(|series| !series.name.is_empty()) {
            chart
                .configure_series_labels()
                .position(legend)
                .background_style(WHITE.mix(0.8))
                .label_font((FONT, TEXT_SIZE, &TEXT))
                .draw()?;
        }
        Ok(())
    }

    /// Corner with the fewest points, and middles between joined points, within two fifths of the
    /// axes.
    fn legend_position(&self, x: &Coordinate, y: &Coordinate) -> SeriesLabelPosition {
        let share = |axis: &Coordinate, value: f64| f64::from(axis.map(&value, (0, 1000))) / 1000.0;
        let mut occupied = Vec::new();
        for series in &self.series {
            let visible = series.points.iter().copied().filter(|&point| self.is_visible(point));
            let points: Vec<(f64, f64)> = visible.map(|point| (share(x, point.0), share(y, point.1))).collect();
            let middle = |pair: &[(f64, f64)]| (0.5 * (pair[0].0 + pair[1].0), 0.5 * (pair[0].1 + pair[1].1));
            occupied.extend(points.windows(2).filter(|_| series.joined).map(middle));
            occupied.extend(points);
        }
        let count = |is_right: bool, is_lower: bool| {
            let near = |share: f64, is_low: bool| if is_low { share < 0.4 } else { share > 0.6 };
            occupied.iter().filter(|(x, y)| near(*x, !is_right) && near(*y, is_lower)).count()
        };
        let corners = [
            (SeriesLabelPosition::UpperLeft, count(false, false)),
            (SeriesLabelPosition::UpperRight, count(true, false)),
            (SeriesLabelPosition::LowerRight, count(true, true)),
            (SeriesLabelPosition::LowerLeft, count(false, true)),
        ];
        let fewest = corners.into_iter().min_by_key(|corner| corner.1);
        fewest.map_or(SeriesLabelPosition::UpperLeft, |corner| corner.0)
    }

    /// Draws the line y = x and the goals, with the label of each goal above its line.
    fn draw_references(&self, chart: &mut Drawn) -> Result<(), Box<dyn std::error::Error>> {
        let (x, y) = (chart.x_range(), chart.y_range());
        if self.diagonal {
            let (low, high) = (x.start.max(y.start), x.end.min(y.end));
            if low < high {
                chart.draw_series(DashedLineSeries::new([(low, low), (high, high)], 4, 3, REFERENCE.into()))?;
            }
        }
        for (goal, label) in &self.goals {
            chart.draw_series(DashedLineSeries::new([(x.start, *goal), (x.end, *goal)], 4, 3, REFERENCE.into()))?;
            let style = (FONT, TEXT_SIZE, &TEXT).into_text_style(&SIZE).pos(Pos::new(HPos::Right, VPos::Bottom));
            chart.draw_series(std::iter::once(Text::new(label.clone(), (x.end, *goal), style)))?;
        }
        Ok(())
    }

    fn draw_series(
        &self,
        chart: &mut Drawn,
        series: &Series,
        color: RGBColor,
    ) -> Result<(), Box<dyn std::error::Error>> {
        let points = || series.points.iter().copied().filter(|&p| self.is_visible(p));
        if series.joined {
            chart.draw_series(LineSeries::new(points(), color.stroke_width(2)))?;
        }
        let marks = chart.draw_series(points().map(|point| Circle::new(point, 3, color.mix(0.6).filled())))?;
        if !series.name.is_empty() {
            marks.label(&series.name).legend(move |(x, y)| Circle::new((x + 10, y), 4, color.filled()));
        }
        Ok(())
    }

    fn is_visible(&self, (x, y): (f64, f64)) -> bool {
        self.x.admits(x) && self.y.admits(y)
    }
}

impl Render for Chart {
    fn render(&self) -> Markup {
        PreEscaped(self.svg())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_finite_point_is_drawn_once_and_text_is_escaped() {
        let series = Series::line("", vec![(1.0, 2.0), (2.0, f64::NAN), (3.0, 5.0)]);
        let chart = Chart { title: "<b> & c".into(), series: vec![series], diagonal: true, ..Chart::default() };
        let svg = chart.svg();
        assert_eq!(svg.matches("<circle").count(), 2);
        assert!(svg.contains("&lt;b&gt; &amp; c"), "{svg}");
        assert!(svg.starts_with("<svg ") && svg.trim_end().ends_with("</svg>"));
    }

    #[test]
    fn a_logarithmic_axis_omits_values_that_are_not_positive() {
        let series = Series::points("a", vec![(0.0, 1.0), (1.0, 1e-3), (10.0, 20.0)]);
        let chart = Chart { x: Axis::log("x"), y: Axis::log("y"), series: vec![series], ..Chart::default() };
        // Two points and the mark of the legend.
        assert_eq!(chart.svg().matches("<circle").count(), 3);
    }

    #[test]
    fn the_legend_is_in_the_emptiest_corner() {
        let series = Series::line("a", vec![(0.0, 10.0), (5.0, 5.0), (10.0, 0.0)]);
        let chart = Chart { series: vec![series], ..Chart::default() };
        let legend = |chart: &Chart| {
            let axis = chart.x.coordinate([0.0, 10.0].into_iter());
            chart.legend_position(&axis, &axis)
        };
        assert!(matches!(legend(&chart), SeriesLabelPosition::UpperRight));
        let rising = Series::line("a", vec![(0.0, 0.0), (5.0, 5.0), (10.0, 10.0)]);
        let chart = Chart { series: vec![rising], ..Chart::default() };
        assert!(matches!(legend(&chart), SeriesLabelPosition::UpperLeft));
    }

    #[test]
    fn charts_without_points_and_with_equal_values_are_drawn() {
        for points in [vec![], vec![(2.0, 2.0)]] {
            for axis in [Axis::new("x"), Axis::log("x")] {
                let series = vec![Series::points("", points.clone())];
                let chart = Chart { x: axis.clone(), y: axis, series, diagonal: true, ..Chart::default() };
                assert_eq!(chart.svg().matches("<circle").count(), points.len());
            }
        }
    }
}
