//! Penetration of blocks as solids, at a time and between two times. Independent of the engine's
//! collision detection, which it judges.

use glam::{DMat3, DQuat, DVec3};
use teeter_physics::{Pose, World};

/// Cuboid at a pose.
///
/// ```
/// use glam::{DQuat, DVec3};
/// use teeter_study::{Solid, max_penetration};
///
/// let block = |z| Solid {
///     center: DVec3::new(0.0, 0.0, z),
///     orientation: DQuat::IDENTITY,
///     half: DVec3::new(0.04, 0.013, 0.009),
/// };
/// assert_eq!(max_penetration(&[block(0.009), block(0.028)]), 0.0);
/// assert!((max_penetration(&[block(0.009), block(0.026)]) - 1e-3).abs() < 1e-9);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Solid {
    /// Centre, m.
    pub center: DVec3,
    /// Unit quaternion from the cuboid's frame to the world.
    pub orientation: DQuat,
    /// Half edge lengths, m.
    pub half: DVec3,
}

/// Sine below which two edges are parallel and their cross product is no axis.
const PARALLEL: f64 = 1e-6;
/// Largest travel between two samples of a motion, m: less than a quarter of the thickness of the
/// thinnest block, so no block is skipped.
const MAX_TRAVEL: f64 = 3e-3;

impl Solid {
    /// Blocks of a world, in order of creation.
    pub fn all(world: &World) -> Vec<Solid> {
        let of = |body| {
            let Pose { position, orientation } = world.pose(body);
            Solid { center: position, orientation, half: 0.5 * world.size(body) }
        };
        world.bodies().map(of).collect()
    }

    /// Half the length of the projection on an axis, m.
    fn half_extent(&self, axes: &DMat3, axis: DVec3) -> f64 {
        (axes.transpose() * axis).abs().dot(self.half)
    }

    /// Shortest distance that separates two cuboids, m; 0 where they are apart. The separating axes
    /// are all face normals and all cross products of edges.
    pub fn penetration(&self, other: &Solid) -> f64 {
        let between = other.center - self.center;
        if between.length_squared()
            >= (self.half.length() + other.half.length()) * (self.half.length() + other.half.length())
        {
            return 0.0;
        }
        let (a, b) = (DMat3::from_quat(self.orientation), DMat3::from_quat(other.orientation));
        let faces = (0..3).flat_map(|i| [a.col(i), b.col(i)]);
        let edges =
            (0..9).map(|i| a.col(i / 3).cross(b.col(i % 3))).filter(|e| e.length() > PARALLEL).map(DVec3::normalize);
        let overlap = |axis: DVec3| self.half_extent(&a, axis) + other.half_extent(&b, axis) - between.dot(axis).abs();
        faces.chain(edges).map(overlap).fold(f64::INFINITY, f64::min).max(0.0)
    }

    /// Height of the highest corner, m.
    pub fn top(&self) -> f64 {
        self.center.z + self.half_extent(&DMat3::from_quat(self.orientation), DVec3::Z)
    }

    /// Depth of the lowest corner below the floor, m; 0 where it is above.
    pub fn below_floor(&self) -> f64 {
        (self.half_extent(&DMat3::from_quat(self.orientation), DVec3::Z) - self.center.z).max(0.0)
    }

    /// Cuboid on the straight line to another pose: 0 is here, 1 there.
    fn interpolate(&self, to: &Solid, share: f64) -> Solid {
        Solid {
            center: self.center.lerp(to.center, share),
            orientation: self.orientation.slerp(to.orientation, share),
            half: self.half,
        }
    }

    /// Upper bound of the travel of any point to another pose, m.
    fn max_travel(&self, to: &Solid) -> f64 {
        self.center.distance(to.center) + self.orientation.angle_between(to.orientation) * self.half.length()
    }
}

/// Largest penetration of any two cuboids, or of one and the floor, m.
pub fn max_penetration(solids: &[Solid]) -> f64 {
    let mut max: f64 = 0.0;
    for (i, a) in solids.iter().enumerate() {
        max = max.max(a.below_floor());
        for b in &solids[i + 1..] {
            max = max.max(a.penetration(b));
        }
    }
    max
}

/// Largest penetration of any two cuboids on the straight lines between two times, m. A cuboid that
/// went through another has been inside it on the line.
///
/// ```
/// use glam::{DQuat, DVec3};
/// use teeter_study::{Solid, max_penetration_between};
///
/// let block = |z| Solid {
///     center: DVec3::new(0.0, 0.0, z),
///     orientation: DQuat::IDENTITY,
///     half: DVec3::new(0.04, 0.013, 0.009),
/// };
/// let (before, after) = ([block(0.1), block(0.13)], [block(0.1), block(0.07)]);
/// assert!(max_penetration_between(&before, &after) > 0.015);
/// ```
pub fn max_penetration_between(before: &[Solid], after: &[Solid]) -> f64 {
    let travels: Vec<f64> = before.iter().zip(after).map(|(a, b)| a.max_travel(b)).collect();
    let mut max: f64 = 0.0;
    for i in 0..before.len() {
        for j in i + 1..before.len() {
            let travel = travels[i] + travels[j];
            let near = before[i].half.length() + before[j].half.length() + travel;
            if travel < MAX_TRAVEL || before[i].center.distance_squared(before[j].center) > near * near {
                continue;
            }
            let samples = (travel / MAX_TRAVEL).ceil() as usize;
            for sample in 1..samples {
                let share = sample as f64 / samples as f64;
                let [a, b] = [i, j].map(|k| before[k].interpolate(&after[k], share));
                max = max.max(a.penetration(&b));
            }
        }
    }
    max
}

#[cfg(test)]
mod tests {
    use super::*;

    fn block(center: [f64; 3], orientation: DQuat) -> Solid {
        Solid { center: center.into(), orientation, half: DVec3::new(0.0405, 0.0134, 0.009) }
    }

    #[test]
    fn the_penetration_is_the_shortest_separating_distance() {
        let a = block([0.0; 3], DQuat::IDENTITY);
        assert!((a.penetration(&block([0.0, 0.0, 0.0178], DQuat::IDENTITY)) - 2e-4).abs() < 1e-12);
        assert!((a.penetration(&block([0.08, 0.02, 0.0], DQuat::IDENTITY)) - 1e-3).abs() < 1e-12);
        assert_eq!(a.penetration(&block([0.0, 0.0, 0.0181], DQuat::IDENTITY)), 0.0);
        // an edge on a face
        let tilted = block([0.0, 0.0, 0.0], DQuat::from_rotation_y(0.3));
        let low = tilted.half_extent(&DMat3::from_quat(tilted.orientation), DVec3::Z);
        let above = Solid { center: DVec3::new(0.0, 0.0, 0.009 + low - 1e-4), ..tilted };
        assert!((a.penetration(&above) - 1e-4).abs() < 1e-6, "{}", a.penetration(&above));
        // crossed edges: two blocks rotated by 45 degrees about their long axes
        let ridge =
            |yaw: DQuat, z: f64| block([0.0, 0.0, z], yaw * DQuat::from_rotation_x(std::f64::consts::FRAC_PI_4));
        let height = ridge(DQuat::IDENTITY, 0.0)
            .half_extent(&DMat3::from_quat(ridge(DQuat::IDENTITY, 0.0).orientation), DVec3::Z);
        let (a, b) = (ridge(DQuat::IDENTITY, 0.0), ridge(DQuat::from_rotation_z(1.2), 2.0 * height + 1e-6));
        assert_eq!(a.penetration(&b), 0.0);
    }

    #[test]
    fn a_block_that_goes_through_another_penetrates_it_in_between() {
        let still = block([0.0; 3], DQuat::IDENTITY);
        let (before, after) = (block([0.0, 0.0, 0.03], DQuat::IDENTITY), block([0.0, 0.0, -0.03], DQuat::IDENTITY));
        assert_eq!(
            max_penetration(&[Solid { center: DVec3::Z, ..still }, Solid { center: DVec3::Z + DVec3::Y, ..before }]),
            0.0
        );
        assert!(max_penetration_between(&[still, before], &[still, after]) > 0.015);
        let aside = Solid { center: DVec3::new(0.0, 0.05, -0.03), ..before };
        assert_eq!(
            max_penetration_between(&[still, Solid { center: DVec3::new(0.0, 0.05, 0.03), ..before }], &[still, aside]),
            0.0
        );
    }
}
