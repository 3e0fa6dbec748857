//! The columns of the report: each a way to simulate a tower, behind one face. A new one is one more entry of [`COLUMNS`].

use glam::{DQuat, DVec3};
use teeter_dissertation::jenga3d::{self, Constants, Disabling, Jenga3D};
use teeter_physics::{Grip, Hand, Input, Params, World};
use teeter_scene::Scene;

use crate::fault::Fault;

/// A block held by a hand.
#[derive(Debug, Clone, Copy)]
pub struct Grasp {
    /// Index of the block.
    pub block: u32,
    /// Where its centre is wanted, m.
    pub target: DVec3,
    /// Whether it is carried, as opposed to slid out of the tower.
    pub carried: bool,
}

/// A tower that is simulated.
pub trait Tower: Send {
    /// Advances it by a sixtieth of a second.
    fn frame(&mut self, hand: Option<&Grasp>);
    /// Number of blocks.
    fn len(&self) -> usize;
    /// Corners of a block, m; bits 0, 1 and 2 of the place say on which side along the block's axes.
    fn corners(&self, block: usize) -> [DVec3; 8];
    /// Whether a block is disabled or asleep.
    fn rests(&self, block: usize) -> bool;
    /// Gives a block a velocity, m/s.
    fn throw(&mut self, block: usize, velocity: DVec3);

    /// Centre of a block, m.
    fn centre(&self, block: usize) -> DVec3 {
        self.corners(block).into_iter().sum::<DVec3>() / 8.0
    }

    /// All centres, m.
    fn centres(&self) -> Vec<DVec3> {
        (0..self.len()).map(|b| self.centre(b)).collect()
    }

    /// Height of the highest corner of some blocks, m.
    fn top(&self, counts: &dyn Fn(usize) -> bool) -> f64 {
        (0..self.len()).filter(|b| counts(*b)).flat_map(|b| self.corners(b)).map(|c| c.z).fold(0.0, f64::max)
    }

    /// Some frames without a hand.
    fn rest(&mut self, frames: u32) {
        for _ in 0..frames {
            self.frame(None);
        }
    }
}

/// Frames in a second of every column.
pub const FRAMES: f64 = 60.0;

/// A column of the report.
#[derive(Clone, Copy)]
pub struct Column {
    /// What stands over it.
    pub name: &'static str,
    /// Builds a scene.
    pub build: fn(&Scene) -> Result<Box<dyn Tower>, Fault>,
}

/// The columns, the dissertation's method first.
pub const COLUMNS: &[Column] = &[
    Column { name: "2003 method", build: springs },
    Column { name: "2003 with 6.3", build: springs_and_future_work },
    Column { name: "rigid", build: rigid },
];

fn springs(scene: &Scene) -> Result<Box<dyn Tower>, Fault> {
    Ok(Box::new(Springs::new(scene, Constants::default())?))
}

/// With static friction and rest by rigid motion, which section 6.3 leaves for later.
fn springs_and_future_work(scene: &Scene) -> Result<Box<dyn Tower>, Fault> {
    let constants = Constants { static_friction: Some(0.4), disabling: Disabling::Rigid, ..Constants::default() };
    Ok(Box::new(Springs::new(scene, constants)?))
}

fn rigid(scene: &Scene) -> Result<Box<dyn Tower>, Fault> {
    let world = World::new(scene, Params::default()).map_err(|e| Fault::at(&scene.name, e))?;
    Ok(Box::new(Rigid { world, carried: None }))
}

/// The dissertation's simulator.
pub struct Springs(pub Jenga3D);

impl Springs {
    /// A scene with these constants.
    pub fn new(scene: &Scene, constants: Constants) -> Result<Self, Fault> {
        Jenga3D::new(scene, constants).map(Self).map_err(|e| Fault::at(&scene.name, e))
    }
}

impl Tower for Springs {
    fn frame(&mut self, hand: Option<&Grasp>) {
        let hand = hand.map(|grasp| jenga3d::Hand { block: grasp.block, target: grasp.target });
        self.0.frame(hand.as_ref());
    }

    fn len(&self) -> usize {
        self.0.model.blocks.len()
    }

    fn corners(&self, block: usize) -> [DVec3; 8] {
        let first = self.0.model.blocks[block].corners().start;
        std::array::from_fn(|c| self.0.curr[first + c].position)
    }

    fn rests(&self, block: usize) -> bool {
        !self.0.model.blocks[block].active
    }

    fn throw(&mut self, block: usize, velocity: DVec3) {
        self.0.throw(block, velocity);
    }
}

/// The engine with rigid blocks.
struct Rigid {
    world: World,
    /// The block that was carried in the last frame, and its orientation when it was taken up.
    carried: Option<(u32, DQuat)>,
}

impl Rigid {
    fn pose(&self, block: usize) -> (DVec3, DQuat) {
        let p = &self.world.poses()[7 * block..][..7];
        (DVec3::new(p[0], p[1], p[2]), DQuat::from_xyzw(p[3], p[4], p[5], p[6]))
    }
}

impl Tower for Rigid {
    fn frame(&mut self, hand: Option<&Grasp>) {
        self.carried = match (hand, self.carried) {
            (Some(grasp), Some((block, held))) if grasp.carried && grasp.block == block => Some((block, held)),
            (Some(grasp), _) if grasp.carried => Some((grasp.block, self.pose(grasp.block as usize).1)),
            _ => None,
        };
        let hand = hand.map(|grasp| Hand {
            body: grasp.block,
            anchor: DVec3::ZERO,
            target: grasp.target,
            orientation: self.carried.map(|(_, held)| held),
            grip: if grasp.carried { Grip::Carry } else { Grip::Slide },
            axis: DVec3::ZERO,
            max_force: Hand::default_force(),
            max_torque: Hand::default_torque(),
        });
        self.world.step(&Input { hand, ..Input::default() });
    }

    fn len(&self) -> usize {
        self.world.len()
    }

    fn corners(&self, block: usize) -> [DVec3; 8] {
        let (centre, turn) = self.pose(block);
        let half = 0.5 * self.world.size(block as u32);
        let side = |c: usize, bit: usize| if c >> bit & 1 == 1 { 1.0 } else { -1.0 };
        std::array::from_fn(|c| centre + turn * (half * DVec3::new(side(c, 0), side(c, 1), side(c, 2))))
    }

    fn rests(&self, block: usize) -> bool {
        self.world.asleep(block as u32)
    }

    fn throw(&mut self, block: usize, velocity: DVec3) {
        self.world.set_velocity(block as u32, velocity, DVec3::ZERO);
    }
}
