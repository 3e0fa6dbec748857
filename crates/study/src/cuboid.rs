//! Blocks as cuboids in the world, strained where their springs are.

use glam::{DMat3, DQuat, DVec3};
use serde::{Deserialize, Serialize};
use teeter_physics::{BodyId, World};
use teeter_scene::Block;

/// Sine below which two edges are parallel and their cross product is no axis.
const PARALLEL: f64 = 1e-6;

/// Block in the world. A block of springs is strained, so its edges need not be perpendicular.
///
/// ```
/// use glam::{DMat3, DVec3};
/// use teeter_study::Cuboid;
///
/// let half = DVec3::new(0.0405, 0.0134, 0.009);
/// let lower = Cuboid { center: DVec3::Z * 0.009, half_edges: DMat3::from_diagonal(half) };
/// let upper = Cuboid { center: DVec3::Z * 0.027, ..lower };
/// assert!((upper.height() - 0.018).abs() < 1e-12 && lower.bottom().abs() < 1e-12);
/// assert!(upper.lies_on(&lower, 1e-3) && !lower.lies_on(&upper, 1e-3));
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Cuboid {
    /// Centre, m.
    pub center: DVec3,
    /// Half edges as columns, m: vectors of the world.
    pub half_edges: DMat3,
}

impl Cuboid {
    /// Blocks of a world, in order of creation.
    pub fn all(world: &World) -> Vec<Self> {
        world.bodies().map(|body| Self::of(world, body)).collect()
    }

    /// Rigid block of a size (m) in a pose.
    pub fn posed(size: DVec3, center: DVec3, orientation: DQuat) -> Self {
        Self { center, half_edges: DMat3::from_quat(orientation) * DMat3::from_diagonal(0.5 * size) }
    }

    /// Block of a scene.
    pub fn of_block(block: &Block) -> Self {
        Self::posed(block.size.into(), block.pos.into(), DQuat::from_array(block.rotation()))
    }

    /// Block of a world.
    ///
    /// # Panics
    /// When the world has no such body.
    pub fn of(world: &World, body: BodyId) -> Self {
        if let Some(lattice) = world.lattice(body) {
            return Self::from_points(&lattice.particles, world.scene().springs.particles.inset());
        }
        let pose = world.pose(body);
        Self::posed(world.size(body), pose.position, pose.orientation)
    }

    /// Cuboid of eight points at `offset` from the centre along each axis, over half the edge: 1
    /// for corners. Bit k of a point's index gives its side along axis k.
    pub fn from_points(points: &[DVec3; 8], offset: f64) -> Self {
        let center = points.iter().sum::<DVec3>() / 8.0;
        let half_edge = |k: usize| {
            let sides = points.iter().enumerate().map(|(i, p)| if i >> k & 1 == 1 { *p } else { -*p });
            sides.sum::<DVec3>() / (8.0 * offset)
        };
        Self { center, half_edges: DMat3::from_cols(half_edge(0), half_edge(1), half_edge(2)) }
    }

    /// Point of the block in the world, m; `local` is from -1 to 1 along each edge.
    pub fn point(&self, local: DVec3) -> DVec3 {
        self.center + self.half_edges * local
    }

    /// Coordinates along the edges of the point of the block that is nearest to a point of the
    /// world, each clamped to the block.
    pub fn nearest(&self, point: DVec3) -> DVec3 {
        (self.half_edges.inverse() * (point - self.center)).clamp(DVec3::NEG_ONE, DVec3::ONE)
    }

    /// Half of the extent along a unit vector, m.
    fn half_extent(&self, axis: DVec3) -> f64 {
        (self.half_edges.transpose() * axis).abs().element_sum()
    }

    /// Vertical extent, m.
    pub fn height(&self) -> f64 {
        2.0 * self.half_extent(DVec3::Z)
    }

    /// Height of the lowest corner, m.
    pub fn bottom(&self) -> f64 {
        self.center.z - self.half_extent(DVec3::Z)
    }

    /// Point of the surface straight below the centre, by its coordinates along the edges. One of
    /// them is -1 or 1: that of the underside.
    pub fn foot(&self) -> DVec3 {
        let down = self.half_edges.inverse() * DVec3::NEG_Z;
        down / down.abs().max_element()
    }

    /// Upper bound of the displacement of any point of the block from another time, m.
    pub fn max_travel(&self, from: &Self) -> f64 {
        let turned = self.half_edges - from.half_edges;
        self.center.distance(from.center) + (0..3).map(|k| turned.col(k).length()).sum::<f64>()
    }

    /// Returns true if the block lies on another: their centres are one above the other, and the
    /// axis that separates them is nearer to the vertical than 45 degrees with a gap of no more
    /// than `max_gap` (m).
    pub fn lies_on(&self, below: &Self, max_gap: f64) -> bool {
        let between = self.center - below.center;
        let reach = self.radius() + below.radius() + max_gap;
        if between.z <= 0.0 || between.length_squared() > reach * reach {
            return false;
        }
        let gap = |axis: &DVec3| between.dot(*axis).abs() - self.half_extent(*axis) - below.half_extent(*axis);
        let widest = self.separating_axes(below).into_iter().map(|axis| (gap(&axis), axis));
        let widest = widest.max_by(|a, b| a.0.total_cmp(&b.0));
        widest.is_some_and(|(gap, axis)| gap <= max_gap && axis.z.abs() > std::f64::consts::FRAC_1_SQRT_2)
    }

    /// Radius of a sphere around the block, m.
    fn radius(&self) -> f64 {
        (0..3).map(|k| self.half_edges.col(k).length()).sum()
    }

    /// Unit normals of the faces of both, and of their pairs of edges.
    fn separating_axes(&self, other: &Self) -> Vec<DVec3> {
        let edges = |m: &DMat3| [0, 1, 2].map(|k| m.col(k).normalize_or_zero());
        let normals = |e: [DVec3; 3]| [0, 1, 2].map(|k| e[(k + 1) % 3].cross(e[(k + 2) % 3]).normalize_or_zero());
        let (a, b) = (edges(&self.half_edges), edges(&other.half_edges));
        let crosses = (0..9).map(|i| a[i / 3].cross(b[i % 3])).filter(|e| e.length() > PARALLEL).map(DVec3::normalize);
        normals(a).into_iter().chain(normals(b)).chain(crosses).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const HALF: DVec3 = DVec3::new(0.0405, 0.0134, 0.009);

    fn block(center: [f64; 3], turn: DQuat) -> Cuboid {
        let half_edges = DMat3::from_quat(turn) * DMat3::from_diagonal(HALF);
        Cuboid { center: center.into(), half_edges }
    }

    #[test]
    fn a_block_lies_on_what_is_beneath_it_and_not_on_its_neighbours() {
        let lower = block([0.0, 0.0, 0.009], DQuat::IDENTITY);
        let across = DQuat::from_rotation_z(std::f64::consts::FRAC_PI_2);
        assert!(block([0.03, 0.0, 0.0271], across).lies_on(&lower, 1e-3));
        assert!(!block([0.03, 0.0, 0.0291], across).lies_on(&lower, 1e-3), "2.1 mm above it");
        assert!(!block([0.0, 0.0271, 0.0095], DQuat::IDENTITY).lies_on(&lower, 1e-3), "beside it, taller by a hair");
        assert!(!block([0.0, 0.07, 0.027], across).lies_on(&lower, 1e-3), "beside it, a row higher");
        // on the ridge of a block that stands on its edge
        let ridge = block([0.0, 0.0, 0.02], DQuat::from_rotation_x(0.6));
        let top = ridge.center.z + 0.5 * ridge.height();
        assert!(block([0.0, 0.0, top + 0.009], DQuat::IDENTITY).lies_on(&ridge, 1e-4));
    }

    #[test]
    fn a_cuboid_of_corners_is_the_one_that_has_them() {
        let turned = block([0.1, -0.2, 0.3], DQuat::from_xyzw(0.3, -0.2, 0.5, 0.7).normalize());
        let side = |i: usize| DVec3::from([0, 1, 2].map(|k| if i >> k & 1 == 1 { 1.0 } else { -1.0 }));
        for offset in [1.0, 0.5] {
            let points = std::array::from_fn(|i| turned.point(offset * side(i)));
            let again = Cuboid::from_points(&points, offset);
            assert!(again.center.distance(turned.center) < 1e-12);
            assert!((again.half_edges - turned.half_edges).to_cols_array().iter().all(|x| x.abs() < 1e-12));
        }
        let foot = turned.point(turned.foot());
        assert!((foot - turned.center).truncate().length() < 1e-12 && foot.z < turned.center.z);
        assert!(turned.nearest(foot).distance(turned.foot()) < 1e-9);
    }
}
