//! Blocks in any orientation, with rounded edges.
//!
//! A rounded block is a box, its core, and all points within the radius of its edges from the core.
//! Two of them penetrate where their cores are nearer than twice the radius.

use glam::{DMat3, DQuat, DVec3};

use crate::scene::Block;

/// Minimum squared sine of the angle between two edges whose common normal is a separating axis.
/// The common normal of edges nearer to parallel is rounding alone, and a face normal separates
/// them.
const MIN_SQUARED_SINE: f64 = 1e-12;

/// Core of a block and the radius around it.
pub struct RoundedBox {
    centre: DVec3,
    /// Axes of the block, as columns.
    axes: DMat3,
    /// Half edges of the core, m.
    core: DVec3,
    /// Radius of the edges, m.
    radius: f64,
}

impl RoundedBox {
    /// Rounded box of a block whose edges have this radius, m.
    pub fn new(b: &Block, radius: f64) -> Self {
        let axes = match b.orientation {
            Some(_) => DMat3::from_quat(DQuat::from_array(b.rotation())),
            None => {
                let (s, c) = libm::sincos(b.yaw);
                DMat3::from_cols(DVec3::new(c, s, 0.0), DVec3::new(-s, c, 0.0), DVec3::Z)
            }
        };
        let core = (0.5 * DVec3::from_array(b.size) - radius).max(DVec3::ZERO);
        Self { centre: DVec3::from_array(b.pos), axes, core, radius }
    }

    /// Half the width of the core's projection on a unit vector, m.
    fn half_width(&self, axis: DVec3) -> f64 {
        self.core.dot((self.axes.transpose() * axis).abs())
    }

    /// Half the extents along x, y and z, m.
    pub fn extent(&self) -> DVec3 {
        let abs = DMat3::from_cols(self.axes.x_axis.abs(), self.axes.y_axis.abs(), self.axes.z_axis.abs());
        abs * self.core + self.radius
    }

    /// Penetration depth (m) and the unit vector along which the other box leaves this one; none
    /// where some axis shows a depth of at most `tolerance` (m). A negative depth is the distance.
    pub fn depth(&self, other: &Self, tolerance: f64) -> Option<(f64, DVec3)> {
        let between = other.centre - self.centre;
        let rounding = self.radius + other.radius;
        let mut best = (f64::INFINITY, DVec3::Z);
        for axis in self.separating_axes(other) {
            let along = between.dot(axis);
            let depth = self.half_width(axis) + other.half_width(axis) - along.abs() + rounding;
            if depth <= tolerance {
                return None;
            }
            if depth < best.0 {
                best = (depth, if along < 0.0 { -axis } else { axis });
            }
        }
        if best.0 >= rounding {
            return Some(best);
        }
        // The cores are apart, and no separating axis need be along their nearest points.
        let gap = self.nearest(other);
        let distance = gap.length();
        let depth = rounding - distance;
        (depth > tolerance).then(|| (depth, if distance > 0.0 { gap / distance } else { best.1 }))
    }

    /// Face normals of both boxes and the common normals of their edges, all of unit length.
    fn separating_axes(&self, other: &Self) -> impl Iterator<Item = DVec3> {
        let (a, b) = (self.axes, other.axes);
        let faces = (0..3).map(move |i| a.col(i)).chain((0..3).map(move |j| b.col(j)));
        let edges = (0..9).filter_map(move |k| {
            let cross = a.col(k / 3).cross(b.col(k % 3));
            let square = cross.length_squared();
            (square > MIN_SQUARED_SINE).then(|| cross / square.sqrt())
        });
        faces.chain(edges)
    }

    /// Vector from this core to the other one between their nearest points, m. The cores must not
    /// overlap.
    fn nearest(&self, other: &Self) -> DVec3 {
        let from_corners = |a: &Self, b: &Self| {
            let gaps = a.corners().map(|corner| b.clamp(corner) - corner);
            gaps.into_iter().fold(DVec3::INFINITY, shorter)
        };
        let mut gap = shorter(from_corners(self, other), -from_corners(other, self));
        for a in self.edges() {
            for b in other.edges() {
                gap = shorter(gap, between_segments(a, b));
            }
        }
        gap
    }

    fn corners(&self) -> [DVec3; 8] {
        std::array::from_fn(|i| {
            let sign = |bit: usize| if i & bit == 0 { -1.0 } else { 1.0 };
            self.centre + self.axes * (self.core * DVec3::new(sign(1), sign(2), sign(4)))
        })
    }

    /// Ends of the edges of the core, m.
    fn edges(&self) -> [[DVec3; 2]; 12] {
        let corners = self.corners();
        // Edge number 4 k + i is along axis k, from the corner whose other two bits are those of i.
        std::array::from_fn(|e| {
            let (bit, i) = (1 << (e / 4), e % 4);
            let from = (i & (bit - 1)) | ((i & !(bit - 1)) << 1);
            [corners[from], corners[from | bit]]
        })
    }

    /// Point of the core nearest to a point, m.
    fn clamp(&self, point: DVec3) -> DVec3 {
        let local = self.axes.transpose() * (point - self.centre);
        self.centre + self.axes * local.clamp(-self.core, self.core)
    }
}

fn shorter(a: DVec3, b: DVec3) -> DVec3 {
    if b.length_squared() < a.length_squared() { b } else { a }
}

/// Vector between the nearest points of two segments, m (Ericson, Real-Time Collision Detection,
/// 5.1.9).
fn between_segments([p0, p1]: [DVec3; 2], [q0, q1]: [DVec3; 2]) -> DVec3 {
    let (u, v, w) = (p1 - p0, q1 - q0, p0 - q0);
    let (a, b, c, d, e) = (u.length_squared(), u.dot(v), v.length_squared(), u.dot(w), v.dot(w));
    if a == 0.0 || c == 0.0 {
        // A core without extent along an edge: its corners cover this case.
        return DVec3::INFINITY;
    }
    let denominator = a * c - b * b;
    let s = if denominator > MIN_SQUARED_SINE * a * c { ((b * e - c * d) / denominator).clamp(0.0, 1.0) } else { 0.0 };
    let t = (b * s + e) / c;
    let (s, t) = if t < 0.0 {
        ((-d / a).clamp(0.0, 1.0), 0.0)
    } else if t > 1.0 {
        (((b - d) / a).clamp(0.0, 1.0), 1.0)
    } else {
        (s, t)
    };
    (q0 + v * t) - (p0 + u * s)
}
