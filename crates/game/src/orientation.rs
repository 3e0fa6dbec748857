//! Orientations of a box: angles between them, symmetry, and the axes that a hand moves along.
//!
//! Only `libm` and plain arithmetic: glam's own angles call the platform's functions, whose last
//! bit differs between targets.

use glam::{DQuat, DVec3};

/// Lean beyond which a block is in no row, rad.
const MAX_LEAN: f64 = 0.3;

/// Angle of the rotation from `a` to `b`, rad, 0 to π.
///
/// ```
/// use glam::{DQuat, DVec3};
/// use teeter_game::angle_between;
///
/// let lean = DQuat::from_rotation_x(0.3);
/// assert!((angle_between(DQuat::IDENTITY, lean) - 0.3).abs() < 1e-9);
/// ```
pub fn angle_between(a: DQuat, b: DQuat) -> f64 {
    2.0 * libm::acos(a.dot(b).abs().min(1.0))
}

/// Rotation about the vertical by `angle`, rad.
pub(crate) fn rotation_about_z(angle: f64) -> DQuat {
    let (sin, cos) = libm::sincos(0.5 * angle);
    DQuat::from_xyzw(0.0, 0.0, sin, cos)
}

/// Returns, of the four orientations in which a box looks the same as in `wanted`, the one nearest
/// to `current`.
///
/// ```
/// use glam::DQuat;
/// use teeter_game::{angle_between, nearest_alike};
///
/// let current = DQuat::from_rotation_z(3.0);
/// assert!(angle_between(nearest_alike(DQuat::IDENTITY, current), current) < 0.15);
/// ```
pub fn nearest_alike(wanted: DQuat, current: DQuat) -> DQuat {
    let half_turns = [DVec3::X, DVec3::Y, DVec3::Z].map(|axis| wanted * DQuat::from_vec4(axis.extend(0.0)));
    let nearer = |best: DQuat, alike: DQuat| {
        if angle_between(alike, current) < angle_between(best, current) { alike } else { best }
    };
    half_turns.into_iter().fold(wanted, nearer)
}

/// Direction in which a hand draws a block out of the tower, unit vector: the block's own long
/// axis, which leans with the tower.
///
/// Drawn level, a leaning block is lifted against what lies above it or pressed on what bears it. A
/// block that leans by more than 0.3 rad is in no row and is drawn level.
///
/// ```
/// use glam::DQuat;
/// use teeter_game::slide_axis;
///
/// assert!((slide_axis(DQuat::from_rotation_y(-0.1)).z - 0.1f64.sin()).abs() < 1e-9);
/// assert_eq!(slide_axis(DQuat::from_rotation_y(-0.5)).z, 0.0);
/// ```
pub fn slide_axis(orientation: DQuat) -> DVec3 {
    let axis = orientation * DVec3::X;
    if axis.z.abs() < libm::sin(MAX_LEAN) {
        return axis;
    }
    let level = axis.with_z(0.0);
    if level.length() > 1e-3 { level.normalize() } else { DVec3::X }
}

/// Returns the orientation nearest to `current` in which the block lies flat, if it is within
/// `limit` (rad), else `current`.
///
/// ```
/// use glam::{DQuat, DVec3};
/// use teeter_game::levelled;
///
/// let lean = DQuat::from_rotation_y(0.2);
/// assert!((levelled(lean, 0.3) * DVec3::Z).z > 1.0 - 1e-9);
/// assert_eq!(levelled(lean, 0.1), lean);
/// ```
pub fn levelled(current: DQuat, limit: f64) -> DQuat {
    let up = current * DVec3::Z;
    let flat = if up.z < 0.0 { DVec3::NEG_Z } else { DVec3::Z };
    let level = rotation_arc(up, flat) * current;
    if angle_between(level, current) <= limit { level } else { current }
}

/// Shortest rotation from one unit vector to another that is not opposite to it.
fn rotation_arc(from: DVec3, to: DVec3) -> DQuat {
    let cross = from.cross(to);
    DQuat::from_xyzw(cross.x, cross.y, cross.z, 1.0 + from.dot(to)).normalize()
}

#[cfg(test)]
mod tests {
    use std::f64::consts::{FRAC_PI_2, PI};

    use super::*;

    fn rotation(axis: DVec3, angle: f64) -> DQuat {
        let (sin, cos) = libm::sincos(0.5 * angle);
        DQuat::from_vec4((axis.normalize() * sin).extend(cos))
    }

    #[test]
    fn the_nearest_of_the_equivalent_orientations_is_taken() {
        let z = rotation_about_z;
        assert!(angle_between(nearest_alike(z(0.0), z(3.0)), z(PI)) < 1e-6);
        assert!(angle_between(nearest_alike(z(0.0), z(0.2)), z(0.0)) < 1e-6);
        let over = rotation(DVec3::X, PI - 0.1);
        assert!((angle_between(nearest_alike(z(0.0), over), over) - 0.1).abs() < 5e-7);
    }

    #[test]
    fn a_block_that_lies_nearly_flat_is_levelled_and_one_on_its_side_is_left() {
        let tilt = |angle| rotation(DVec3::new(1.0, 1.0, 0.0), angle);
        let up = |q: DQuat| (q * DVec3::Z).z;
        assert!((up(levelled(tilt(0.2), 0.3)) - 1.0).abs() < 5e-10);
        assert!((up(levelled(tilt(PI - 0.2), 0.3)) + 1.0).abs() < 5e-10);
        assert!(angle_between(levelled(tilt(1.2), 0.3), tilt(1.2)) < 1e-6);
    }

    #[test]
    fn a_block_that_leans_too_far_for_a_row_is_drawn_level() {
        let leaning = |angle| slide_axis(rotation(DVec3::Y, angle));
        assert!((leaning(-0.2).z - libm::sin(0.2)).abs() < 5e-10);
        for angle in [0.5, 1.0, FRAC_PI_2, 2.0] {
            assert_eq!(leaning(angle).z, 0.0);
            assert!((leaning(angle).length() - 1.0).abs() < 5e-10);
        }
    }
}
