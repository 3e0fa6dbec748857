//! Pose of a block and its strain.

use glam::{DMat3, DQuat, DVec3};
use teeter_physics::{BodyId, Pose, World};
use teeter_scene::{Particles, Scene};

/// Pose of a block, and the strain of one with soft springs inside.
///
/// ```
/// use glam::DVec3;
/// use teeter_render::poses;
///
/// let scene = teeter_scene::named("block").expect("a named scene");
/// let pose = poses(&scene)[0];
/// assert_eq!(pose.axes() * DVec3::X, DVec3::X);
/// assert_eq!(pose.pose.position, DVec3::from_array(scene.blocks[0].pos));
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StrainedPose {
    /// Position and orientation.
    pub pose: Pose,
    /// Map of the block's frame to itself, the identity without strain.
    pub strain: DMat3,
}

impl From<Pose> for StrainedPose {
    fn from(pose: Pose) -> Self {
        Self { pose, strain: DMat3::IDENTITY }
    }
}

impl StrainedPose {
    /// Returns the pose of a body of a world. The strain of a lattice is that of the affine map
    /// which fits its particles best, as the surfaces of the block follow it in the engine.
    ///
    /// # Panics
    /// When the body is of another world.
    pub fn of(world: &World, body: BodyId) -> Self {
        let pose = world.pose(body);
        let Some(lattice) = world.lattice(body) else { return pose.into() };
        let offset = match world.scene().springs.particles {
            Particles::Inside => 1.0 / 3.0f64.sqrt(),
            Particles::Corners => 1.0,
        };
        // Σ p_i s_ik / (8 g_k) for particle i at p_i, on side s_ik of axis k, at distance g_k from
        // the centre.
        let column = |k: usize| {
            let side = |i: usize| if (i >> k) & 1 == 1 { 1.0 } else { -1.0 };
            let sum: DVec3 = (0..8).map(|i| side(i) * (lattice.particles[i] - pose.position)).sum();
            pose.orientation.inverse() * (sum / (4.0 * offset * world.size(body)[k]))
        };
        Self { pose, strain: DMat3::from_cols(column(0), column(1), column(2)) }
    }

    /// Map of directions of the unstrained block to the world.
    pub fn axes(&self) -> DMat3 {
        DMat3::from_quat(self.pose.orientation) * self.strain
    }

    /// Returns the pose between two, `self` at 0 and `after` at 1.
    pub fn lerp(&self, after: &Self, part: f64) -> Self {
        let pose = Pose {
            position: self.pose.position.lerp(after.pose.position, part),
            // The shorter of the two rotations, as two quaternions of one orientation differ in
            // sign.
            orientation: self.pose.orientation.lerp(after.pose.orientation, part),
        };
        Self { pose, strain: self.strain * (1.0 - part) + after.strain * part }
    }
}

/// Returns the poses of the blocks of a scene as it stands, before it settles.
pub fn poses(scene: &Scene) -> Vec<StrainedPose> {
    let pose = |block: &teeter_scene::Block| Pose {
        position: block.pos.into(),
        orientation: DQuat::from_array(block.rotation()),
    };
    scene.blocks.iter().map(|block| pose(block).into()).collect()
}

#[cfg(test)]
mod tests {
    use teeter_physics::Params;
    use teeter_scene::{Form, named};

    use super::*;

    /// A soft column is compressed along the vertical, most at its foot, and a stiff one is not.
    #[test]
    fn a_soft_column_is_compressed_by_its_weight() {
        let strains = |stiffness: f64| -> Vec<f64> {
            let mut scene = Scene { form: Form::Lattice, ..named("column").unwrap() };
            scene.springs.stiffness = Some(stiffness);
            let mut world = World::new(&scene, Params::default()).unwrap();
            world.run_for(1.0);
            world.bodies().map(|body| 1.0 - StrainedPose::of(&world, body).strain.z_axis.z).collect()
        };
        let (soft, stiff) = (strains(3e3), strains(1e6));
        assert!(soft[0] > 0.005 && soft[0] > soft[5] && soft[5] > soft[9], "{soft:?}");
        assert!(stiff.iter().all(|strain| strain.abs() < 1e-3), "{stiff:?}");
    }
}
