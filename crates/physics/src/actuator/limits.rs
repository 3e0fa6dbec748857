//! Limits of what acts on a body from outside, so that no input harms any body but the one it
//! names.
//!
//! Force and torque are limited by the acceleration of the body's points: within the substeps
//! between two checks of the travel budgets, a body then moves by a fraction of its own size, and
//! every number stays far inside of single precision.

use glam::{DQuat, DVec3};

use crate::body::{Shapes, point_speed};
use crate::constants::MAX_ACCELERATION;

/// Shortens a vector to a length of at most `max`. Finite vectors of any size are handled, also
/// those of which the squares overflow.
pub fn shortened(v: DVec3, max: f64) -> DVec3 {
    let largest = v.abs().max_element();
    // A vector is at most sqrt(3) times as long as its largest component.
    if largest <= 0.5 * max {
        return v;
    }
    let direction = v / largest;
    let length = direction.length();
    if length * largest <= max { v } else { direction * (max / length) }
}

/// Returns a quaternion of length 1 in the direction of `q`; none where `q` is not finite or has no
/// direction.
pub fn unit(q: DQuat) -> Option<DQuat> {
    let largest = q.to_array().into_iter().fold(0.0, |largest: f64, x| largest.max(x.abs()));
    if !q.is_finite() || largest == 0.0 {
        return None;
    }
    // The square of such a number is zero or infinite.
    let scale = if (1e-100..1e100).contains(&largest) { 1.0 } else { largest };
    Some((q / scale).normalize())
}

/// Maximum force on body `i`, N.
pub fn max_force(shapes: &Shapes, i: usize) -> f64 {
    shapes.mass[i] * MAX_ACCELERATION
}

/// Maximum torque on body `i` about any axis, N m.
pub fn max_torque(shapes: &Shapes, i: usize) -> f64 {
    MAX_ACCELERATION / turning_gain(shapes, i)
}

/// Limits the sum of the applied forces (N) and torques (N m) on body `i`, in the order of
/// `orientation`.
pub fn limited(shapes: &Shapes, i: usize, orientation: DQuat, (force, torque): (DVec3, DVec3)) -> (DVec3, DVec3) {
    let force = shortened(force, max_force(shapes, i));
    let angular = (orientation.conjugate() * torque) / shapes.inertia[i];
    let acceleration = point_speed(shapes.half[i], angular);
    let torque = if acceleration <= MAX_ACCELERATION { torque } else { torque * (MAX_ACCELERATION / acceleration) };
    (force, torque)
}

/// Upper bound of the speed that a force (N) with a lever arm (m) gives to the points of body `i`
/// within `time` (s), m/s.
pub fn speed_gain(shapes: &Shapes, i: usize, (force, arm): (f64, f64), time: f64) -> f64 {
    let linear = (force / shapes.mass[i]).min(MAX_ACCELERATION);
    let turning = (force * arm * turning_gain(shapes, i)).min(MAX_ACCELERATION);
    (linear + turning) * time
}

/// Acceleration of the fastest point of body `i` over the torque about the axis that turns it
/// most easily, 1/(kg m).
fn turning_gain(shapes: &Shapes, i: usize) -> f64 {
    let half = shapes.half[i];
    let gain = |axis: DVec3| point_speed(half, axis) / shapes.inertia[i].dot(axis);
    gain(DVec3::X).max(gain(DVec3::Y)).max(gain(DVec3::Z))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn vectors_of_any_size_are_shortened_in_their_direction() {
        for size in [1e-300, 1e-3, 0.9, 1.5, 1e40, 1e154, 1e200, 1e307] {
            let v = DVec3::new(3.0, -4.0, 12.0) / 13.0 * size;
            let short = shortened(v, 1.0);
            assert!((short.length() - size.min(1.0)).abs() < 1e-12, "{size}: {short}");
            assert!((short / size.min(1.0)).distance(DVec3::new(3.0, -4.0, 12.0) / 13.0) < 1e-12);
        }
        // what is within the limit keeps its bits
        let v = DVec3::new(0.1, 0.7, 0.3);
        assert_eq!(shortened(v, 0.8), v);
    }

    #[test]
    fn quaternions_of_any_size_have_a_direction() {
        let q = DQuat::from_xyzw(0.5, -0.5, 0.5, 0.5);
        for size in [1e-320, 1e-200, 1e-3, 1.0, 7.0, 1e200, 1e308] {
            let unit = unit(DQuat::from_vec4(glam::DVec4::from(q) * size)).unwrap();
            assert!((unit.length() - 1.0).abs() < 1e-12 && unit.dot(q) > 1.0 - 1e-3, "{size}: {unit}");
        }
        assert_eq!(unit(DQuat::from_array([0.0; 4])), None);
        assert_eq!(unit(DQuat::from_array([0.0, f64::NAN, 0.0, 1.0])), None);
        assert_eq!(unit(DQuat::from_array([0.0, 0.0, f64::INFINITY, 1.0])), None);
    }
}
