//! Box against box: faces that meet flat, rounded edges and corners, and boxes whose cores overlap.
//!
//! Crossed blocks touch edge against edge at the corners of their overlap; only clipping finds
//! these points. Where no faces meet, the nearest points of the cores decide: a step lower than the
//! radii has a normal that tilts with its height, so a seam is no wall, and parallel edges that
//! lean against each other have a normal of their own.

#[cfg(test)]
mod tests;

use crate::collision::cuboid::Cuboid;
use crate::collision::edge_contact::{crossing_edges, round_contact};
use crate::collision::face_contact::FacePair;
use crate::collision::lookahead::Approach;
use crate::collision::manifold::{Manifold, SeparatingAxis};
use crate::collision::nearest::{Feature, Nearest, nearest};
use crate::collision::pair_status::{PairStatus, Range};
use crate::collision::separating_axis::{LastAxis, Separation, separation};
use crate::constants::{FLAT_SINE, MIN_NEAR_TRAVEL, ROUND_TRAVEL};

/// Tests two boxes, `low` having the lower index; they are apart where some axis separates them by
/// more than the limit of the range. Where they touch, `to` becomes their manifold, which is too
/// large to return by value.
pub fn box_box(low: &Cuboid, high: &Cuboid, range: Range, last: Option<LastAxis>, to: &mut Manifold) -> PairStatus {
    let Some(found) = separation(low, high, range.limit, last) else { return PairStatus::Apart };
    if found.distance > range.reach {
        return PairStatus::Near(found.distance);
    }
    let faces = face_pair(low, high, &found);
    if let Some(pair) = faces.filter(FacePair::is_flat)
        && pair.contact(to)
    {
        to.axis = found.axis;
        return PairStatus::Touching(f64::INFINITY);
    }
    if low.radius + high.radius > 0.0
        && let Some(nearest) = nearest(&low.core(), &high.core())
    {
        return rounded_contact(low, high, &nearest, range.reach, to);
    }
    to.axis = found.axis;
    let touching = match (faces, found.axis) {
        (Some(pair), _) => pair.contact(to),
        (None, SeparatingAxis::Edges(pair)) => {
            crossing_edges(low, high, pair as usize, found.normal, to);
            true
        }
        (None, _) => false,
    };
    if touching {
        PairStatus::Touching(f64::INFINITY)
    } else {
        PairStatus::Near((0.5 * found.distance).max(MIN_NEAR_TRAVEL))
    }
}

/// Face of a separating axis, and the face that faces it; none where the axis is that of two edges.
fn face_pair<'a>(low: &'a Cuboid, high: &'a Cuboid, found: &Separation) -> Option<FacePair<'a>> {
    match found.axis {
        SeparatingAxis::FaceLow(i) => Some(FacePair::new(low, high, i as usize, found.normal)),
        SeparatingAxis::FaceHigh(j) => Some(FacePair::new(high, low, j as usize, -found.normal)),
        SeparatingAxis::Edges(_) | SeparatingAxis::Cores => None,
    }
}

/// Contact of two boxes whose cores are apart: of a face where that is nearest or the normal is
/// nearly its own, so that an edge that rests across a face gets both its ends; of rounded edges or
/// corners elsewhere.
fn rounded_contact(low: &Cuboid, high: &Cuboid, nearest: &Nearest, reach: f64, to: &mut Manifold) -> PairStatus {
    let gap = nearest.distance - low.radius - high.radius;
    if gap > reach {
        return PairStatus::Near(gap);
    }
    let axis_of = |c: &Cuboid, feature| match feature {
        Feature::Face(i) => Some(i),
        _ => (0..3).find(|&i| c.axes.col(i).cross(nearest.normal).length_squared() < FLAT_SINE * FLAT_SINE),
    };
    let outward = |c: &Cuboid, i: usize, direction| c.axes.col(i) * c.axes.col(i).dot(direction).signum();
    let [on_low, on_high] = nearest.features;
    if let Some(i) = axis_of(low, on_low)
        && FacePair::new(low, high, i, outward(low, i, nearest.normal)).contact(to)
    {
        to.axis = SeparatingAxis::FaceLow(i as u8);
        return PairStatus::Touching(f64::INFINITY);
    }
    if let Some(j) = axis_of(high, on_high)
        && FacePair::new(high, low, j, outward(high, j, -nearest.normal)).contact(to)
    {
        to.axis = SeparatingAxis::FaceHigh(j as u8);
        return PairStatus::Touching(f64::INFINITY);
    }
    let travel = PairStatus::Touching((0.5 * gap).max(ROUND_TRAVEL * (low.radius + high.radius)));
    let approach = Approach::new(low, high, nearest);
    if let Some(approach) = &approach
        && coming_faces(low, high, approach, to)
    {
        return travel;
    }
    let turned = approach.map_or(*nearest, |approach| approach.turned(low, high, nearest));
    round_contact(low, high, &turned, to);
    to.axis = SeparatingAxis::Cores;
    travel
}

/// Sets the manifold of faces that will meet before the next detection. Returns false if there are
/// none, or only deep inside each other.
fn coming_faces(low: &Cuboid, high: &Cuboid, approach: &Approach, to: &mut Manifold) -> bool {
    let moved = approach.moved(high);
    let Some(found) = separation(low, &moved, f64::INFINITY, None) else { return false };
    to.axis = found.axis;
    face_pair(low, &moved, &found).is_some_and(|pair| pair.is_flat() && pair.contact(to))
        && approach.bring_back(low, high, to)
}
