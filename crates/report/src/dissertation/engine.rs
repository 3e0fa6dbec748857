//! Engine of Teeter, with rigid blocks or lattices.

use glam::{DQuat, DVec3};
use teeter_dissertation::jenga3d::counters::Rounds;
use teeter_physics::{BodyId, BuildError, Grip, Hand, Input, Params, Pose, Twist, World};
use teeter_scene::{Form, Scene};

use super::backend::{Backend, FrameReport, Grasp};
use super::cost;

/// Engine of Teeter.
pub struct Engine {
    world: World,
    /// Distance of the particles of a lattice from the centre, over that of the corners.
    inset: f64,
    /// Block in the hand in the last frame, and its orientation when it was grasped.
    grasped: Option<(u32, DQuat)>,
}

impl Engine {
    /// Builds a scene with blocks of a form, which sleep at rest or not.
    ///
    /// # Errors
    /// When the scene is not valid.
    pub fn new(scene: &Scene, form: Form, sleep: bool) -> Result<Self, BuildError> {
        let world = World::new(&Scene { form, ..scene.clone() }, Params { sleep, ..Params::default() })?;
        Ok(Self { world, inset: scene.springs.particles.inset(), grasped: None })
    }

    /// Hand that keeps the orientation in which it grasped its block.
    fn hand(&mut self, grasp: Option<&Grasp>) -> Option<Hand> {
        self.grasped = grasp.map(|grasp| match self.grasped {
            Some((block, orientation)) if block == grasp.block => (block, orientation),
            _ => (grasp.block, self.world.pose(BodyId(grasp.block)).orientation),
        });
        let (grasp, (block, orientation)) = grasp.zip(self.grasped)?;
        let grip = if grasp.carried { Grip::Carry } else { Grip::Slide };
        Some(Hand { grip, ..Hand::slide(BodyId(block), DVec3::ZERO, grasp.target, orientation) })
    }
}

impl Backend for Engine {
    fn len(&self) -> usize {
        self.world.len()
    }

    fn step(&mut self, hand: Option<&Grasp>) -> FrameReport {
        let hand = self.hand(hand);
        let report = self.world.step(&Input { hand, ..Input::default() });
        FrameReport {
            operations: cost::of_world(&self.world, &report),
            resting: self.world.bodies().map(|body| self.world.is_asleep(body)).collect(),
            rounds: Rounds::default(),
        }
    }

    fn corners(&self, block: usize) -> [DVec3; 8] {
        let body = BodyId(block as u32);
        let side = |c: usize, bit: usize| if c >> bit & 1 == 1 { 1.0 } else { -1.0 };
        let (centre, axes) = match self.world.lattice(body) {
            None => {
                let Pose { position, orientation } = self.world.pose(body);
                let half = 0.5 * self.world.size(body);
                (position, [half.x * DVec3::X, half.y * DVec3::Y, half.z * DVec3::Z].map(|axis| orientation * axis))
            }
            // The surface follows the affine part of the motion of the particles, which are inside
            // the block.
            Some(lattice) => {
                let mean =
                    |sign: &dyn Fn(usize) -> f64| (0..8).map(|c| lattice.particles[c] * sign(c)).sum::<DVec3>() / 8.0;
                (mean(&|_| 1.0), [0, 1, 2].map(|bit| mean(&|c| side(c, bit)) / self.inset))
            }
        };
        let [x, y, z] = axes;
        std::array::from_fn(|c| centre + side(c, 0) * x + side(c, 1) * y + side(c, 2) * z)
    }

    fn set_velocity(&mut self, block: usize, velocity: DVec3) {
        self.world.set_twist(BodyId(block as u32), Twist::linear(velocity));
    }
}
