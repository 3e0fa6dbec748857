//! Box against floor.

use glam::DVec3;

use crate::body::FLOOR;
use crate::collision::cuboid::Cuboid;
use crate::collision::face_contact::rounding;
use crate::collision::manifold::{ContactPoint, Manifold, SeparatingAxis};
use crate::collision::pair_status::{PairStatus, Range};
use crate::collision::polygon::{Corner, Patch};

/// Index of the axis of a box whose face is lowest, given the world's upward direction in the box's
/// frame. Hysteresis keeps a box balanced on an edge on the face of the last detection.
#[inline]
fn lowest_face(up: DVec3, last: Option<SeparatingAxis>) -> usize {
    let mut k = 0;
    let mut best = f64::NEG_INFINITY;
    for i in 0..3 {
        let merit = up[i].abs() + if last == Some(SeparatingAxis::FaceHigh(i as u8)) { 0.01 } else { 0.0 };
        if merit > best {
            best = merit;
            k = i;
        }
    }
    k
}

/// Tests a box against the floor z = 0; they are apart where the box is higher than the limit of
/// the range. The points are the corners of its lowest face.
pub fn box_floor(b: &Cuboid, range: Range, last: Option<SeparatingAxis>, to: &mut Manifold) -> PairStatus {
    let up = b.axes.transpose() * DVec3::Z;
    let height = b.center.z - up.abs().dot(b.half);
    if height > range.limit {
        return PairStatus::Apart;
    }
    if height > range.reach {
        return PairStatus::Near(height);
    }
    let k = lowest_face(up, last);
    let outward = if up[k] > 0.0 { -1.0 } else { 1.0 };
    let (ip, iq) = ((k + 1) % 3, (k + 2) % 3);
    let mut center = DVec3::ZERO;
    center[k] = outward * b.half[k];
    let sides = [(1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0), (1.0, -1.0)];
    // A tilted block bears on its rounding, which lies one radius below the core. The floor has no
    // edges, so sharp blocks keep theirs.
    let radius = if b.rounded { b.radius } else { 0.0 };
    let inset = radius * rounding((up[ip] * up[ip] + up[iq] * up[iq]).sqrt());
    let half = [b.half[ip] - inset, b.half[iq] - inset];
    let rise = DVec3::from_array(std::array::from_fn(|i| if i == k { -outward * radius } else { 0.0 })) - up * radius;
    let patch = Patch::new(&sides.map(|(x, y)| Corner { u: x * half[0], v: y * half[1], gap: 0.0 }));
    let middle = b.center + b.axes * center;
    let centroid = DVec3::new(middle.x, middle.y, 0.0);
    let frame = [DVec3::Z, DVec3::X, DVec3::Y];
    let points = sides.iter().map(|(x, y)| {
        let mut anchor_b = center;
        anchor_b[ip] = x * half[0];
        anchor_b[iq] = y * half[1];
        anchor_b += rise;
        let corner = b.center + b.axes * anchor_b;
        let mut point =
            ContactPoint { anchor_b, follows: [true; 2], weight: 0.25, gap: corner.z, ..ContactPoint::default() };
        point.move_on_a(DVec3::new(corner.x, corner.y, 0.0), &frame, centroid);
        point
    });
    to.axis = SeparatingAxis::FaceHigh(k as u8);
    to.set([FLOOR, b.body], (frame, centroid), &patch, points);
    PairStatus::Touching(f64::INFINITY)
}
