//! Blocks as solids: whether two are inside each other, and whether one went through another between two looks. Separate from the engine's own detection,
//! which it is to judge.

use glam::{DMat3, DQuat, DVec3};
use teeter_physics::{Pose, World};

/// A cuboid somewhere in space.
#[derive(Debug, Clone, Copy)]
pub struct Solid {
    /// Centre, m.
    pub center: DVec3,
    /// Orientation.
    pub turn: DQuat,
    /// Half edge lengths, m.
    pub half: DVec3,
}

/// Sine below which two edges are parallel and their cross product says nothing.
const PARALLEL: f64 = 1e-6;
/// Way between two places that are looked at, m: less than a quarter of the thinnest block, so none is stepped over.
const LOOK: f64 = 3e-3;

impl Solid {
    /// All blocks of a world.
    pub fn all(world: &World) -> Vec<Solid> {
        let of = |body| {
            let Pose { position, orientation } = world.pose(body);
            Solid { center: position, turn: orientation, half: 0.5 * world.size(body) }
        };
        world.bodies().map(of).collect()
    }

    /// Half the width of its shadow on an axis, m.
    fn reach(&self, axes: &DMat3, axis: DVec3) -> f64 {
        (axes.transpose() * axis).abs().dot(self.half)
    }

    /// The least distance that parts two cuboids, m; 0 where they are apart. Separating axes: all face normals and all products of edges.
    pub fn depth(&self, other: &Solid) -> f64 {
        let between = other.center - self.center;
        if between.length_squared()
            >= (self.half.length() + other.half.length()) * (self.half.length() + other.half.length())
        {
            return 0.0;
        }
        let (a, b) = (DMat3::from_quat(self.turn), DMat3::from_quat(other.turn));
        let faces = (0..3).flat_map(|i| [a.col(i), b.col(i)]);
        let edges =
            (0..9).map(|i| a.col(i / 3).cross(b.col(i % 3))).filter(|e| e.length() > PARALLEL).map(DVec3::normalize);
        let overlap = |axis: DVec3| self.reach(&a, axis) + other.reach(&b, axis) - between.dot(axis).abs();
        faces.chain(edges).map(overlap).fold(f64::INFINITY, f64::min).max(0.0)
    }

    /// Height of its highest corner, m.
    pub fn top(&self) -> f64 {
        self.center.z + self.reach(&DMat3::from_quat(self.turn), DVec3::Z)
    }

    /// How far its lowest corner is below the floor, m; 0 where it is above.
    pub fn below_floor(&self) -> f64 {
        (self.reach(&DMat3::from_quat(self.turn), DVec3::Z) - self.center.z).max(0.0)
    }

    /// A share of the way to another place of the same cuboid.
    fn towards(&self, to: &Solid, share: f64) -> Solid {
        Solid { center: self.center.lerp(to.center, share), turn: self.turn.slerp(to.turn, share), half: self.half }
    }

    /// How far any point of it goes on the way to another place, at most, m.
    fn way(&self, to: &Solid) -> f64 {
        self.center.distance(to.center) + self.turn.angle_between(to.turn) * self.half.length()
    }
}

/// Deepest overlap of any two, or of one and the floor, m.
pub fn deepest(solids: &[Solid]) -> f64 {
    let mut deepest: f64 = 0.0;
    for (i, a) in solids.iter().enumerate() {
        deepest = deepest.max(a.below_floor());
        for b in &solids[i + 1..] {
            deepest = deepest.max(a.depth(b));
        }
    }
    deepest
}

/// Deepest overlap on the straight way between two looks at the same cuboids, m: what went through another between them has been inside it.
pub fn deepest_between(before: &[Solid], after: &[Solid]) -> f64 {
    let ways: Vec<f64> = before.iter().zip(after).map(|(a, b)| a.way(b)).collect();
    let mut deepest: f64 = 0.0;
    for i in 0..before.len() {
        for j in i + 1..before.len() {
            let way = ways[i] + ways[j];
            let near = before[i].half.length() + before[j].half.length() + way;
            if way < LOOK || before[i].center.distance_squared(before[j].center) > near * near {
                continue;
            }
            let looks = (way / LOOK).ceil() as usize;
            for look in 1..looks {
                let share = look as f64 / looks as f64;
                deepest = deepest.max(before[i].towards(&after[i], share).depth(&before[j].towards(&after[j], share)));
            }
        }
    }
    deepest
}

#[cfg(test)]
mod tests {
    use super::*;

    fn block(center: [f64; 3], turn: DQuat) -> Solid {
        Solid { center: center.into(), turn, half: DVec3::new(0.0405, 0.0134, 0.009) }
    }

    #[test]
    fn the_depth_is_the_least_way_out() {
        let a = block([0.0; 3], DQuat::IDENTITY);
        assert!((a.depth(&block([0.0, 0.0, 0.0178], DQuat::IDENTITY)) - 2e-4).abs() < 1e-12);
        assert!((a.depth(&block([0.08, 0.02, 0.0], DQuat::IDENTITY)) - 1e-3).abs() < 1e-12);
        assert_eq!(a.depth(&block([0.0, 0.0, 0.0181], DQuat::IDENTITY)), 0.0);
        // an edge on a face
        let tilted = block([0.0, 0.0, 0.0], DQuat::from_rotation_y(0.3));
        let low = tilted.reach(&DMat3::from_quat(tilted.turn), DVec3::Z);
        let above = Solid { center: DVec3::new(0.0, 0.0, 0.009 + low - 1e-4), ..tilted };
        assert!((a.depth(&above) - 1e-4).abs() < 1e-6, "{}", a.depth(&above));
        // crossed edges: two blocks turned by 45 degrees about their own long axes
        let ridge =
            |turn: DQuat, z: f64| block([0.0, 0.0, z], turn * DQuat::from_rotation_x(std::f64::consts::FRAC_PI_4));
        let height = ridge(DQuat::IDENTITY, 0.0).reach(&DMat3::from_quat(ridge(DQuat::IDENTITY, 0.0).turn), DVec3::Z);
        let (a, b) = (ridge(DQuat::IDENTITY, 0.0), ridge(DQuat::from_rotation_z(1.2), 2.0 * height + 1e-6));
        assert_eq!(a.depth(&b), 0.0);
    }

    #[test]
    fn what_went_through_is_seen() {
        let still = block([0.0; 3], DQuat::IDENTITY);
        let (before, after) = (block([0.0, 0.0, 0.03], DQuat::IDENTITY), block([0.0, 0.0, -0.03], DQuat::IDENTITY));
        assert_eq!(
            deepest(&[Solid { center: DVec3::Z, ..still }, Solid { center: DVec3::Z + DVec3::Y, ..before }]),
            0.0
        );
        assert!(deepest_between(&[still, before], &[still, after]) > 0.015);
        let aside = Solid { center: DVec3::new(0.0, 0.05, -0.03), ..before };
        assert_eq!(
            deepest_between(&[still, Solid { center: DVec3::new(0.0, 0.05, 0.03), ..before }], &[still, aside]),
            0.0
        );
    }
}
