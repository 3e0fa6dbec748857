//! Validity of a state that comes from outside: every index is in range, and every number is one
//! that a world can have.

use glam::{DQuat, DVec3};

use crate::body::{Bodies, FLOOR, Shapes, point_speed};
use crate::collision::cached_pair::CachedPair;
use crate::collision::manifold::{Manifold, SeparatingAxis};

/// Maximum deviation from length 1, and from a right angle, that rounding may have caused.
const ROUNDING: f64 = 1e-6;
/// Maximum speed of a body and of its points about the centre, m/s: above that at which a body is
/// frozen, since a sync may turn a spin to an axis of less inertia.
const MAX_STORED_SPEED: f64 = 1e8;

/// Returns true if the bodies can be those of `shapes`: unit orientations, possible speeds, and
/// nothing that moves although it is asleep or held.
pub fn are_bodies(bodies: &Bodies, shapes: &Shapes) -> bool {
    let poses = bodies.detection_pose.iter().chain(&bodies.rest_pose).map(|(_, q)| q);
    let not_negative = [&bodies.acceleration, &bodies.margin, &bodies.rest_time];
    bodies.orientation.iter().chain(poses).all(|q| is_unit(*q))
        && not_negative.into_iter().flatten().all(|x| *x >= 0.0)
        && (0..bodies.len()).all(|i| {
            let spin = bodies.orientation[i].conjugate() * bodies.spin[i];
            let still = bodies.velocity[i] == DVec3::ZERO && bodies.spin[i] == DVec3::ZERO;
            (bodies.is_active(i) || still)
                && bodies.velocity[i].length() <= MAX_STORED_SPEED
                && point_speed(shapes.half[i], spin) <= MAX_STORED_SPEED
        })
}

/// Returns true if the manifolds can be those of `n` bodies: sorted, between two bodies or a body
/// and the floor, and with a right-handed frame.
pub fn are_manifolds(manifolds: &[Manifold], n: usize) -> bool {
    let in_range = |m: &Manifold| (m.b as usize) < n && m.a != m.b && (m.a == FLOOR || (m.a as usize) < n);
    manifolds.iter().all(|m| in_range(m) && is_axis(m.axis) && is_frame(&m.frame) && has_points(m))
        && manifolds.is_sorted_by(|m, next| m.key() < next.key())
}

/// Returns true if the cached pairs can be those of `n` bodies: sorted, and between two bodies or a
/// body and the floor.
pub fn are_cached(cache: &[CachedPair], n: usize) -> bool {
    let in_range = |[low, high]: [u32; 2]| (low == FLOOR || low < high) && (high as usize) < n;
    let valid = |cached: &CachedPair| cached.reach >= 0.0 && cached.limit >= 0.0 && is_unit(cached.pose.1);
    cache.iter().all(|cached| in_range(cached.pair) && valid(cached))
        && cache.is_sorted_by(|cached, next| cached.key() < next.key())
}

/// Returns true if a quaternion has length 1.
pub fn is_unit(q: DQuat) -> bool {
    (q.length_squared() - 1.0).abs() < ROUNDING
}

fn is_axis(axis: SeparatingAxis) -> bool {
    match axis {
        SeparatingAxis::FaceLow(k) | SeparatingAxis::FaceHigh(k) => k < 3,
        SeparatingAxis::Edges(k) => k < 9,
        SeparatingAxis::Cores => true,
    }
}

fn is_frame([normal, u, v]: &[DVec3; 3]) -> bool {
    normal.is_normalized() && u.is_normalized() && normal.cross(*u).distance(*v) < ROUNDING
}

fn has_points(manifold: &Manifold) -> bool {
    let valid = |weight: f64, force: f64| (0.0..=1.0 + ROUNDING).contains(&weight) && force >= 0.0;
    manifold.area_ratio > 0.0
        && manifold.mobility >= 0.0
        && manifold.free_depth >= 0.0
        && manifold.points.iter().all(|p| valid(p.weight, p.normal_force))
}
