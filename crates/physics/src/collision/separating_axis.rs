//! Separating axis test of two boxes, on the face axes of both and the cross products of their
//! edges.

use glam::{DMat3, DVec3};

use crate::collision::cuboid::Cuboid;
use crate::collision::manifold::SeparatingAxis;
use crate::constants::{AXIS_HYSTERESIS, EDGE_PREFERENCE, MIN_EDGE_SINE, MIN_EDGE_TILT};

/// Component of the last normal along an axis from which the axis keeps its side.
const SAME_SIDE: f64 = 0.5;

/// Result of the separating axis test: normal from the first box to the second, and separation
/// along it, m.
#[derive(Debug, Clone, Copy)]
pub struct Separation {
    pub axis: SeparatingAxis,
    pub normal: DVec3,
    pub distance: f64,
}

/// Axis of the last detection of a pair.
#[derive(Debug, Clone, Copy)]
pub struct LastAxis {
    pub axis: SeparatingAxis,
    /// Normal from the first box to the second.
    pub normal: DVec3,
}

/// Best axis so far in a separating axis test.
#[derive(Clone, Copy)]
struct Candidate {
    /// Separation with preference and hysteresis, m.
    merit: f64,
    axis: SeparatingAxis,
    /// Separation, m.
    distance: f64,
    /// Offset of the second box along the axis, of which only the sign is used.
    offset: f64,
}

/// Separating axis test of two boxes.
struct AxisTest<'a> {
    low: &'a Cuboid,
    high: &'a Cuboid,
    limit: f64,
    last: Option<LastAxis>,
    /// Normal of the last detection in the axes of each box; zero where there was none.
    last_in_low: DVec3,
    last_in_high: DVec3,
    /// Dot products of the axes: `dots.col(j)[i]` = a_i . b_j, and their absolute values.
    dots: DMat3,
    abs: DMat3,
    /// Offset of the centres along the axes of each box, m.
    in_low: DVec3,
    in_high: DVec3,
}

impl<'a> AxisTest<'a> {
    #[inline]
    fn new(low: &'a Cuboid, high: &'a Cuboid, limit: f64, last: Option<LastAxis>) -> Self {
        let normal = last.map_or(DVec3::ZERO, |last| last.normal);
        let offset = high.center - low.center;
        let dots = low.axes.transpose() * high.axes;
        Self {
            low,
            high,
            limit,
            last,
            last_in_low: low.axes.transpose() * normal,
            last_in_high: high.axes.transpose() * normal,
            dots,
            abs: DMat3::from_cols(dots.x_axis.abs(), dots.y_axis.abs(), dots.z_axis.abs()),
            in_low: low.axes.transpose() * offset,
            in_high: high.axes.transpose() * offset,
        }
    }

    /// Replaces `best` by an axis of higher merit.
    #[inline]
    fn consider(&self, best: &mut Candidate, axis: SeparatingAxis, offset: f64, (distance, handicap): (f64, f64)) {
        let merit =
            distance - handicap + if self.last.is_some_and(|last| last.axis == axis) { AXIS_HYSTERESIS } else { 0.0 };
        if merit > best.merit {
            *best = Candidate { merit, axis, distance, offset };
        }
    }

    /// Offset along an axis, and separation, of boxes that reach `reach` along it. A box that has
    /// been pressed beyond the middle of another stays on the side on which they met, or it would
    /// be pushed out on the far one. `last` is the component of the last normal.
    #[inline]
    fn on_side(offset: f64, reach: f64, last: f64) -> (f64, f64) {
        if last.abs() > SAME_SIDE && offset * last < 0.0 && offset.abs() < reach {
            (-offset, -offset.abs() - reach)
        } else {
            (offset, offset.abs() - reach)
        }
    }

    /// Best face axis; none where a face axis separates the boxes by more than the limit.
    #[inline]
    fn faces(&self) -> Option<Candidate> {
        let axis = SeparatingAxis::FaceLow(0);
        let mut best = Candidate { merit: f64::NEG_INFINITY, axis, distance: 0.0, offset: 0.0 };
        let reach = self.low.half + self.abs * self.high.half;
        for i in 0..3 {
            let (offset, distance) = Self::on_side(self.in_low[i], reach[i], self.last_in_low[i]);
            if distance > self.limit {
                return None;
            }
            self.consider(&mut best, SeparatingAxis::FaceLow(i as u8), offset, (distance, 0.0));
        }
        let reach = self.high.half + self.abs.transpose() * self.low.half;
        for j in 0..3 {
            let (offset, distance) = Self::on_side(self.in_high[j], reach[j], self.last_in_high[j]);
            if distance > self.limit {
                return None;
            }
            self.consider(&mut best, SeparatingAxis::FaceHigh(j as u8), offset, (distance, 0.0));
        }
        Some(best)
    }

    /// Best edge axis; none where an edge axis separates the boxes by more than the limit.
    #[inline]
    fn edges(&self, faces: &Candidate) -> Option<Candidate> {
        let axis = SeparatingAxis::FaceLow(0);
        let mut best = Candidate { merit: f64::NEG_INFINITY, axis, distance: 0.0, offset: 0.0 };
        let (low, high, dots, abs) = (self.low, self.high, &self.dots, &self.abs);
        for i in 0..3 {
            let (i1, i2) = ((i + 1) % 3, (i + 2) % 3);
            for j in 0..3 {
                let (j1, j2) = ((j + 1) % 3, (j + 2) % 3);
                let cosine = dots.col(j)[i];
                let square = 1.0 - cosine * cosine;
                if square < MIN_EDGE_SINE * MIN_EDGE_SINE {
                    continue;
                }
                // Projections on a_i x b_j, whose length is the sine (Gottschalk, Lin and Manocha,
                // OBBTree, 1996).
                let offset = self.in_low[i2] * dots.col(j)[i1] - self.in_low[i1] * dots.col(j)[i2];
                let reach_low = low.half[i1] * abs.col(j)[i2] + low.half[i2] * abs.col(j)[i1];
                let reach_high = high.half[j1] * abs.col(j2)[i] + high.half[j2] * abs.col(j1)[i];
                let last = self.last_in_low[i2] * dots.col(j)[i1] - self.last_in_low[i1] * dots.col(j)[i2];
                let (offset, scaled) = Self::on_side(offset, reach_low + reach_high, last);
                // Division by the sine only lowers a negative separation: an axis below the best
                // stays below it.
                if scaled < 0.0 && scaled - EDGE_PREFERENCE + AXIS_HYSTERESIS <= faces.merit.max(best.merit) {
                    continue;
                }
                let distance = scaled / square.sqrt();
                if distance > self.limit {
                    return None;
                }
                let axis = SeparatingAxis::Edges((3 * i + j) as u8);
                self.consider(&mut best, axis, offset, (distance, EDGE_PREFERENCE));
            }
        }
        Some(best)
    }

    /// Separation along an axis, with the normal from the first box to the second.
    #[inline]
    fn separation(&self, Candidate { axis, distance, offset, .. }: Candidate) -> Separation {
        let (a, b) = (&self.low.axes, &self.high.axes);
        let normal = match axis {
            SeparatingAxis::FaceLow(i) => a.col(i as usize),
            SeparatingAxis::FaceHigh(j) => b.col(j as usize),
            SeparatingAxis::Cores => unreachable!("the test knows axes of faces and edges only"),
            SeparatingAxis::Edges(pair) => a.col(pair as usize / 3).cross(b.col(pair as usize % 3)).normalize(),
        };
        Separation { axis, normal: if offset < 0.0 { -normal } else { normal }, distance }
    }
}

/// Separating axis test of two boxes, with a preference for faces and for the axis of the last
/// detection. Returns none where some axis separates them by more than `limit` (m).
pub fn separation(low: &Cuboid, high: &Cuboid, limit: f64, last: Option<LastAxis>) -> Option<Separation> {
    let test = AxisTest::new(low, high, limit, last);
    let faces = test.faces()?;
    let edges = test.edges(&faces)?;
    let face = test.separation(faces);
    if edges.merit > faces.merit {
        let edge = test.separation(edges);
        if edge.normal.cross(face.normal).length_squared() > MIN_EDGE_TILT * MIN_EDGE_TILT {
            return Some(edge);
        }
    }
    Some(face)
}
