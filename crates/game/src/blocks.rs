//! Geometry of the blocks at the end of a frame.
//!
//! Two maps lead from a block's frame to the world. The pose alone carries what belongs to the
//! block as a whole, such as the point at which a hand holds it. The surface is strained besides,
//! where the block has soft springs inside.

use glam::{DMat3, DQuat, DVec3};
use teeter_physics::{BodyId, POSE_STRIDE};
use teeter_study::Cuboid;

use crate::simulator::Simulator;

/// Poses, edge lengths and strains of all blocks.
///
/// ```
/// use teeter_game::Blocks;
/// use teeter_physics::{BodyId, Params, World};
///
/// let scene = teeter_scene::named("tower").unwrap();
/// let blocks = Blocks::of(&World::new(&scene, Params::default())?);
/// assert_eq!(blocks.len(), 54);
/// assert!((blocks.position(BodyId(0)).z - 0.5 * blocks.size(BodyId(0)).z).abs() < 1e-3);
/// # Ok::<(), teeter_physics::BuildError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Blocks {
    sizes: Vec<DVec3>,
    positions: Vec<DVec3>,
    orientations: Vec<DQuat>,
    /// Maps of directions in the block's frame from the block as made to the block as strained;
    /// empty where all are rigid.
    strains: Vec<DMat3>,
}

impl Blocks {
    /// Rigid blocks of edge lengths `sizes` (m) at `poses`, seven numbers each.
    pub fn new(sizes: Vec<DVec3>, poses: &[f64]) -> Self {
        let (positions, orientations) = split(poses);
        Self { sizes, positions, orientations, strains: Vec::new() }
    }

    /// The blocks of a simulator.
    pub fn of<S: Simulator>(simulator: &S) -> Self {
        let sizes = (0..simulator.len() as u32).map(|body| simulator.size(BodyId(body))).collect();
        let mut blocks = Self::new(sizes, simulator.poses());
        blocks.refresh(simulator);
        blocks
    }

    /// Takes over the poses and strains of a simulator of as many bodies.
    pub fn refresh<S: Simulator>(&mut self, simulator: &S) {
        (self.positions, self.orientations) = split(simulator.poses());
        self.strains.clear();
        let offset = simulator.particle_offset();
        for body in self.bodies() {
            let Some(particles) = simulator.particles(body) else { break };
            let strain = self.strain(body, &particles, offset);
            self.strains.push(strain);
        }
    }

    /// Strains the blocks by their particles at `offset` from the centre, over half the edge.
    #[cfg(test)]
    pub(crate) fn set_particles(&mut self, particles: &[[DVec3; 8]], offset: f64) {
        self.strains =
            self.bodies().zip(particles).map(|(body, particles)| self.strain(body, particles, offset)).collect();
    }

    /// Strain R⁻¹ F of a block with F = Σ p_i s_ik / (8 g_k), for particle i at p_i on side s_ik of
    /// axis k at g_k from the centre.
    fn strain(&self, body: BodyId, particles: &[DVec3; 8], offset: f64) -> DMat3 {
        let (inverse, size) = (self.orientation(body).conjugate(), self.size(body));
        let column = |k: usize| {
            let sides = particles.iter().enumerate().map(|(i, p)| if i >> k & 1 == 1 { *p } else { -*p });
            inverse * (sides.sum::<DVec3>() / (4.0 * offset * size[k]))
        };
        DMat3::from_cols(column(0), column(1), column(2))
    }

    /// Number of blocks.
    pub fn len(&self) -> usize {
        self.positions.len()
    }

    /// True when there is no block.
    pub fn is_empty(&self) -> bool {
        self.positions.is_empty()
    }

    /// Ids of all blocks.
    pub fn bodies(&self) -> impl ExactSizeIterator<Item = BodyId> + DoubleEndedIterator + use<> {
        (0..self.len() as u32).map(BodyId)
    }

    /// Edge lengths of a block as made, m.
    pub fn size(&self, body: BodyId) -> DVec3 {
        self.sizes[body.index()]
    }

    /// Centre of a block, m.
    pub fn position(&self, body: BodyId) -> DVec3 {
        self.positions[body.index()]
    }

    /// Centres of all blocks, m.
    pub fn positions(&self) -> &[DVec3] {
        &self.positions
    }

    /// Orientation of a block.
    pub fn orientation(&self, body: BodyId) -> DQuat {
        self.orientations[body.index()]
    }

    /// True when the blocks have particles, and so may be strained.
    pub fn is_strained(&self) -> bool {
        !self.strains.is_empty()
    }

    /// A point of the block's frame in the world, by the pose alone, m.
    pub fn point(&self, body: BodyId, local: DVec3) -> DVec3 {
        self.position(body) + self.orientation(body) * local
    }

    /// A point of the block as made in the world, where strain has moved it, m.
    pub fn surface(&self, body: BodyId, local: DVec3) -> DVec3 {
        self.position(body) + self.axes(body) * local
    }

    /// Map of directions from the block as made to the world: strain and rotation.
    pub fn axes(&self, body: BodyId) -> DMat3 {
        let rotation = DMat3::from_quat(self.orientation(body));
        self.strains.get(body.index()).map_or(rotation, |strain| rotation * *strain)
    }

    /// Edge lengths of a block as strained, m.
    pub fn edges(&self, body: BodyId) -> DVec3 {
        let axes = self.axes(body);
        let stretch = DVec3::new(axes.x_axis.length(), axes.y_axis.length(), axes.z_axis.length());
        self.size(body) * stretch
    }

    /// Half of the extent of a block along a unit direction of the world, m.
    pub fn half_extent(&self, body: BodyId, direction: DVec3) -> f64 {
        0.5 * (self.axes(body).transpose() * direction).abs().dot(self.size(body))
    }

    /// All blocks as strained.
    pub fn cuboids(&self) -> Vec<Cuboid> {
        let cuboid = |body| Cuboid {
            center: self.position(body),
            half_edges: self.axes(body) * DMat3::from_diagonal(0.5 * self.size(body)),
        };
        self.bodies().map(cuboid).collect()
    }
}

fn split(poses: &[f64]) -> (Vec<DVec3>, Vec<DQuat>) {
    poses.chunks_exact(POSE_STRIDE).map(|pose| (DVec3::from_slice(pose), DQuat::from_slice(&pose[3..]))).unzip()
}

#[cfg(test)]
pub(crate) mod samples {
    //! Towers for tests of geometry: rows of three, each crossing the one below.

    use glam::{DQuat, DVec3};
    use teeter_physics::BodyId;

    use super::Blocks;
    use crate::orientation::rotation_about_z;

    pub const SIZE: DVec3 = DVec3::new(0.081, 0.0268, 0.018);
    pub const PITCH: f64 = 0.0268 + 0.0003;

    /// Rows as text, bottom first: `x` is a block, `.` none. The tower is turned by `yaw` (rad)
    /// about the vertical.
    pub fn tower(rows: &[&str], yaw: f64) -> Blocks {
        let mut poses = Vec::new();
        for (r, row) in rows.iter().enumerate() {
            for (c, _) in row.char_indices().filter(|(_, cell)| *cell == 'x') {
                let side = (c as f64 - 1.0) * PITCH;
                let (x, y) = if r % 2 == 1 { (side, 0.0) } else { (0.0, side) };
                let position = rotation_about_z(yaw) * DVec3::new(x, y, (r as f64 + 0.5) * SIZE.z);
                let turn = rotation_about_z(yaw + (r % 2) as f64 * std::f64::consts::FRAC_PI_2);
                push(&mut poses, position, turn);
            }
        }
        blocks(&poses)
    }

    /// The tower with one pose changed.
    pub fn moved(tower: &Blocks, body: u32, by: DVec3) -> Blocks {
        let mut poses = Vec::new();
        for other in tower.bodies() {
            let shift = if other == BodyId(body) { by } else { DVec3::ZERO };
            push(&mut poses, tower.position(other) + shift, tower.orientation(other));
        }
        blocks(&poses)
    }

    pub fn blocks(poses: &[f64]) -> Blocks {
        Blocks::new(vec![SIZE; poses.len() / 7], poses)
    }

    pub fn push(poses: &mut Vec<f64>, position: DVec3, orientation: DQuat) {
        poses.extend(position.to_array().into_iter().chain(orientation.to_array()));
    }
}

#[cfg(test)]
mod tests {
    use super::samples::{SIZE, blocks, push};
    use super::*;

    #[test]
    fn the_surface_of_a_block_is_that_of_its_particles_and_the_pose_carries_a_point() {
        let body = BodyId(0);
        let position = DVec3::new(0.02, -0.03, 0.2);
        let orientation = DQuat::from_xyzw(0.3, -0.2, 0.5, 0.7).normalize();
        let compressed = |p: DVec3| DVec3::new(1.02 * p.x + 0.1 * p.z, 1.05 * p.y, 0.8 * p.z);
        let mut poses = Vec::new();
        push(&mut poses, position, orientation);
        let mut blocks = blocks(&poses);
        assert!(!blocks.is_strained());
        let offset = 1.0 / 3f64.sqrt();
        let particles = std::array::from_fn(|i| {
            let side = DVec3::from([0, 1, 2].map(|k| if i >> k & 1 == 1 { 0.5 } else { -0.5 }));
            position + orientation * compressed(side * offset * SIZE)
        });
        blocks.set_particles(&[particles], offset);
        assert!(blocks.is_strained());
        let corner = 0.5 * SIZE;
        assert!(blocks.surface(body, corner).distance(position + orientation * compressed(corner)) < 1e-7);
        assert!(blocks.point(body, corner).distance(position + orientation * corner) < 1e-7);
        let edges = blocks.edges(body);
        assert!((edges.x - 1.02 * SIZE.x).abs() < 5e-7);
        assert!((edges.z - 0.65f64.sqrt() * SIZE.z).abs() < 5e-7);
        let up = orientation * DVec3::Z;
        assert!((blocks.half_extent(body, up) - 0.4 * SIZE.z).abs() < 5e-7);
    }
}
