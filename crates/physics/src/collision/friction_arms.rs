//! Friction arms: where the friction of the points of a manifold acts.
//!
//! [`FrictionLevers`](crate::collision::friction_levers::FrictionLevers) take the offsets of the
//! points from the centre of pressure, at which the resultant acts. Friction acts in the plane of
//! the contact, so a centre at which the bodies are apart would be a point of neither: the friction
//! of a long block that meets the floor with one end would twist it about its length.

use std::cell::LazyCell;

use crate::body::{Bodies, FLOOR, Shapes};
use crate::collision::friction_levers::{Slip, SlipLevers};
use crate::collision::manifold::{ContactPoint, Manifold};
use crate::collision::passivity::thickness;
use crate::collision::relative_twist::RelativeTwist;
use crate::constants::{FIRST_TOUCH, SYNC_TIME};

/// Lever of friction along the tangents, and turning arm, of each point of a manifold, m.
pub fn friction_arms(manifold: &Manifold, shapes: &Shapes, bodies: &Bodies) -> impl Fn(&ContactPoint) -> [f64; 3] {
    let (center, levers) = levers(manifold, shapes, bodies);
    move |p| {
        let [x, y, turning_arm] = levers.arms([p.arm[0] - center[0], p.arm[1] - center[1]]);
        [center[0] + x, center[1] + y, turning_arm]
    }
}

/// Centre of pressure of a manifold, offset from its centroid along the tangents (m), and levers
/// about it.
fn levers(manifold: &Manifold, shapes: &Shapes, bodies: &Bodies) -> ([f64; 2], SlipLevers) {
    let tolerance = FIRST_TOUCH * thickness(manifold, shapes);
    let flat = flat_share(manifold, tolerance);
    let pressed = weighted_center(manifold, |p| p.normal_force);
    // Most contacts of blocks that tumble are pressed and tilted, and need none.
    let motion = LazyCell::new(|| motion(manifold, shapes, bodies));
    let center = pressed.unwrap_or_else(|| first_touch(manifold, tolerance, &motion));
    if flat == 0.0 {
        return (center, SlipLevers::of_edge());
    }
    let levers = manifold.levers.at(&motion.slip(center));
    // A patch that lies flat keeps its levers to the last bit.
    (center, if flat < 1.0 { levers.mixed_with_edge(flat) } else { levers })
}

/// Motion of B relative to A; none where both bodies are [still](Slip::is_negligible).
fn motion(manifold: &Manifold, shapes: &Shapes, bodies: &Bodies) -> RelativeTwist {
    let still = |i: u32| i == FLOOR || Slip::is_negligible(bodies.squared_speed_bound(shapes, i as usize));
    if still(manifold.a) && still(manifold.b) {
        return RelativeTwist::default();
    }
    RelativeTwist::of(manifold, bodies)
}

/// Centre of the points at which bodies that are apart will touch first: offset from the centroid
/// along the tangents, m.
///
/// Points that will then be open by up to the `tolerance` (m) count too, or the centre of a patch
/// that lands flat would hang on rounding.
fn first_touch(manifold: &Manifold, tolerance: f64, motion: &RelativeTwist) -> [f64; 2] {
    let touch_time = |p: &ContactPoint| match p.gap + manifold.free_depth {
        gap if gap <= 0.0 => 0.0,
        gap => gap / (-motion.opening(p.arm)).max(f64::MIN_POSITIVE),
    };
    let time = manifold.points.iter().map(touch_time).fold(f64::INFINITY, f64::min);
    // Until then the bodies are synced, and may move otherwise.
    let time = if time < SYNC_TIME { time } else { 0.0 };
    let gap = |p: &ContactPoint| p.gap + motion.opening(p.arm) * time;
    let lowest = manifold.points.iter().map(gap).fold(f64::INFINITY, f64::min);
    weighted_center(manifold, |p| p.weight * (lowest + tolerance - gap(p)).max(0.0)).unwrap_or_default()
}

/// Share to which a patch lies flat, from 0 to 1: gaps that differ by up to the `tolerance` (m) are
/// flat, by twice as much tilted.
fn flat_share(manifold: &Manifold, tolerance: f64) -> f64 {
    let (mut lowest, mut highest) = (f64::INFINITY, f64::NEG_INFINITY);
    for p in &manifold.points {
        (lowest, highest) = (lowest.min(p.gap), highest.max(p.gap));
    }
    (2.0 - (highest - lowest) / tolerance).clamp(0.0, 1.0)
}

/// Weighted mean of the offsets of the points of a manifold from its centroid, m; none where no
/// point has weight.
fn weighted_center(manifold: &Manifold, weight: impl Fn(&ContactPoint) -> f64) -> Option<[f64; 2]> {
    let (mut total, mut moment) = (0.0, [0.0; 2]);
    for p in &manifold.points {
        let weight = weight(p);
        total += weight;
        moment = [moment[0] + weight * p.arm[0], moment[1] + weight * p.arm[1]];
    }
    (total > 0.0).then(|| moment.map(|moment| moment / total))
}

#[cfg(test)]
mod tests {
    use glam::{DQuat, DVec3};
    use teeter_scene::{Scene, named};

    use super::*;
    use crate::params::Params;
    use crate::world::World;

    const HALF: [f64; 3] = [0.5, 0.01, 0.0015];

    /// World with a ruler in an orientation, whose lowest corner is `height` (m) above the floor.
    fn ruler(orientation: DQuat, height: f64, [velocity, spin]: [[f64; 3]; 2]) -> World {
        let mut scene: Scene = named("block").unwrap();
        let block = &mut scene.blocks[0];
        let below = (orientation.conjugate() * DVec3::Z).abs().dot(HALF.into());
        (block.size, block.pos) = (HALF.map(|half| 2.0 * half), [0.1, 0.2, below + height]);
        block.orientation = Some(orientation.to_array());
        (block.velocity, block.spin) = (velocity, spin);
        World::new(&scene, Params::default()).unwrap()
    }

    /// Offset from the centre of the ruler of each point and of its lever of friction, in its
    /// frame, and turning arm, m; the lowest points first.
    fn levers(world: &World) -> Vec<(DVec3, DVec3, f64)> {
        let cluster = &world.clusters.list[0];
        let manifold = &cluster.contacts.manifolds[0];
        let arms = friction_arms(manifold, &cluster.shapes, &cluster.bodies);
        let (center, axes) = cluster.bodies.pose(0);
        let mut points: Vec<_> = manifold.points.iter().collect();
        points.sort_by(|p, q| p.gap.total_cmp(&q.gap));
        let local = |x, y| axes.transpose() * (manifold.centroid + DVec3::new(x, y, 0.0) - center);
        let of = |p: &ContactPoint| {
            let [x, y, turn] = arms(p);
            (local(p.arm[0], p.arm[1]), local(x, y), turn)
        };
        points.into_iter().map(of).collect()
    }

    #[test]
    fn friction_of_a_corner_acts_at_the_corner() {
        let tilt = DQuat::from_rotation_y(0.3) * DQuat::from_rotation_x(0.4);
        for orientation in [tilt, DQuat::from_rotation_z(2.0) * tilt, tilt * DQuat::from_rotation_z(3.0)] {
            // At rest above the floor, and falling towards it.
            for motion in [[[0.0; 3]; 2], [[0.3, -0.2, -2.0], [0.0; 3]]] {
                let (corner, lever, turn) = levers(&ruler(orientation, 5e-5, motion))[0];
                assert!(lever.distance(corner) < 1e-12 && turn == 0.0, "{lever} of {corner}, {turn}");
            }
        }
    }

    #[test]
    fn friction_of_an_end_acts_on_its_edge() {
        let world = ruler(DQuat::from_rotation_z(0.7) * DQuat::from_rotation_y(0.2), 5e-5, [[0.0; 3]; 2]);
        for (corner, lever, _) in &levers(&world)[..2] {
            // The quarter of a line load on the edge, halfway from its middle.
            let middle = DVec3::new(corner.x, 0.0, corner.z);
            assert!(lever.distance(0.5 * (middle + *corner)) < 1e-9, "{lever} of {corner}");
        }
    }

    #[test]
    fn friction_of_a_face_acts_at_its_quarters() {
        let world = ruler(DQuat::from_rotation_z(0.7), 5e-5, [[0.0; 3]; 2]);
        let levers = levers(&world);
        let mean: DVec3 = levers.iter().map(|(_, lever, _)| 0.25 * lever).sum();
        assert!(mean.truncate().length() < 1e-9, "{mean} of {levers:?}");
        // In a row along the ruler: two about an eighth of its length from the middle, two three.
        let mut along: Vec<f64> = levers.iter().map(|(_, lever, _)| lever.x.abs()).collect();
        along.sort_by(f64::total_cmp);
        assert!(along[1] < 0.15 && along[2] > 0.3 && along[3] < 0.4, "{along:?}");
    }

    #[test]
    fn the_end_that_closes_first_counts_and_not_the_lower_one() {
        // The higher end is 1 mm above the lower, which rises; it falls at 30 m/s.
        let motion = [[0.0, 0.0, -14.0], [0.0, -30.0, 0.0]];
        let lowest = levers(&ruler(DQuat::from_rotation_y(1e-3), 5e-5, motion));
        let [near, far] = [lowest[0], lowest[3]];
        assert!(near.0.x * far.0.x < 0.0);
        assert!((far.1.x - far.0.x).abs() < 1e-9, "{} of {}", far.1, far.0);
    }
}
