//! The columns of the report: each a way to simulate a tower, behind one face. A new one is one more entry of [`COLUMNS`].

use glam::{DQuat, DVec3};
use teeter_dissertation::jenga3d::{self, Constants, Disabling, Jenga3D};
use teeter_physics::{BodyId, Grip, Hand, Input, Params, Pose, Twist, World};
use teeter_scene::{Form, Scene};

use super::work;
use crate::error::Error;

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
    /// What the last frame cost, floating-point operations.
    fn work(&self) -> f64;
    /// Gives a block a velocity, m/s.
    fn throw(&mut self, block: usize, velocity: DVec3);

    /// Centre of a block, m.
    fn centre(&self, block: usize) -> DVec3 {
        self.corners(block).into_iter().sum::<DVec3>() / 8.0
    }

    /// Unit vector along the length of a block, towards its corners of bit 0.
    fn along(&self, block: usize) -> DVec3 {
        let corners = self.corners(block);
        (0..8).map(|c| if c & 1 == 1 { corners[c] } else { -corners[c] }).sum::<DVec3>().normalize_or_zero()
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
    /// Its colour in charts.
    pub colour: &'static str,
    /// Builds a scene.
    pub build: fn(&Scene) -> Result<Box<dyn Tower>, Error>,
}

/// The columns, the dissertation's method first.
pub const COLUMNS: &[Column] = &[
    Column { name: "2003 method", colour: "#b5482f", build: springs },
    Column { name: "2003 with 6.3", colour: "#c98a1b", build: springs_and_future_work },
    ENGINE[0],
    ENGINE[1],
];

/// Those of the engine.
pub const ENGINE: [Column; 2] = [
    Column { name: "lattice", colour: "#2f6fb5", build: lattice },
    Column { name: "rigid", colour: "#3f8f4f", build: rigid },
];

fn springs(scene: &Scene) -> Result<Box<dyn Tower>, Error> {
    Ok(Box::new(Springs::new(scene, Constants::default())?))
}

/// With static friction and rest by rigid motion, which section 6.3 leaves for later.
fn springs_and_future_work(scene: &Scene) -> Result<Box<dyn Tower>, Error> {
    let constants = Constants { static_friction: Some(0.4), disabling: Disabling::Rigid, ..Constants::default() };
    Ok(Box::new(Springs::new(scene, constants)?))
}

/// With springs as stiff as the contacts.
fn lattice(scene: &Scene) -> Result<Box<dyn Tower>, Error> {
    engine(scene, Form::Lattice)
}

fn rigid(scene: &Scene) -> Result<Box<dyn Tower>, Error> {
    engine(scene, Form::Rigid)
}

fn engine(scene: &Scene, form: Form) -> Result<Box<dyn Tower>, Error> {
    let world =
        World::new(&Scene { form, ..scene.clone() }, Params::default()).map_err(|e| Error::at(&scene.name, e))?;
    Ok(Box::new(Engine { world, place: scene.springs.particles.inset(), grasped: None, work: 0.0 }))
}

/// The dissertation's simulator.
pub struct Springs {
    /// The simulator.
    pub simulator: Jenga3D,
    work: f64,
}

impl Springs {
    /// A scene with these constants.
    pub fn new(scene: &Scene, constants: Constants) -> Result<Self, Error> {
        let simulator = Jenga3D::new(scene, constants).map_err(|e| Error::at(&scene.name, e))?;
        Ok(Self { simulator, work: 0.0 })
    }
}

impl Tower for Springs {
    fn frame(&mut self, hand: Option<&Grasp>) {
        let hand = hand.map(|grasp| jenga3d::Hand { block: grasp.block, target: grasp.target });
        let report = self.simulator.frame(hand.as_ref());
        self.work = work::of_springs(&self.simulator, &report.tests);
    }

    fn len(&self) -> usize {
        self.simulator.model.blocks.len()
    }

    fn corners(&self, block: usize) -> [DVec3; 8] {
        let first = self.simulator.model.blocks[block].corners().start;
        std::array::from_fn(|c| self.simulator.curr[first + c].position)
    }

    fn rests(&self, block: usize) -> bool {
        !self.simulator.model.blocks[block].active
    }

    fn work(&self) -> f64 {
        self.work
    }

    fn throw(&mut self, block: usize, velocity: DVec3) {
        self.simulator.throw(block, velocity);
    }
}

/// The engine, with blocks of either form.
struct Engine {
    world: World,
    /// How far the particles of springs are from the centre, over how far the corners are.
    place: f64,
    /// The block that was in the hand in the last frame, and its orientation when it was grasped, which the hand keeps.
    grasped: Option<(u32, DQuat)>,
    work: f64,
}

impl Tower for Engine {
    fn frame(&mut self, hand: Option<&Grasp>) {
        self.grasped = hand.map(|grasp| match self.grasped {
            Some((block, held)) if block == grasp.block => (block, held),
            _ => (grasp.block, self.world.pose(BodyId(grasp.block)).orientation),
        });
        let hand = hand.zip(self.grasped).map(|(grasp, (block, held))| Hand {
            grip: if grasp.carried { Grip::Carry } else { Grip::Slide },
            ..Hand::slide(BodyId(block), DVec3::ZERO, grasp.target, held)
        });
        let report = self.world.step(&Input { hand, ..Input::default() });
        self.work = work::of_world(&self.world, &report);
    }

    fn len(&self) -> usize {
        self.world.len()
    }

    fn corners(&self, block: usize) -> [DVec3; 8] {
        let body = BodyId(block as u32);
        let side = |c: usize, bit: usize| if c >> bit & 1 == 1 { 1.0 } else { -1.0 };
        let (centre, axes) = match self.world.lattice(body) {
            None => {
                let Pose { position: centre, orientation: turn } = self.world.pose(body);
                let half = 0.5 * self.world.size(body);
                (centre, [turn * (half.x * DVec3::X), turn * (half.y * DVec3::Y), turn * (half.z * DVec3::Z)])
            }
            // Surfaces follow what is affine in the places of the particles, which stand within the block.
            Some(springs) => {
                let mean = |signed: &dyn Fn(usize) -> f64| {
                    (0..8).map(|c| springs.particles[c] * signed(c)).sum::<DVec3>() / 8.0
                };
                (mean(&|_| 1.0), [0, 1, 2].map(|bit| mean(&|c| side(c, bit)) / self.place))
            }
        };
        let [x, y, z] = axes;
        std::array::from_fn(|c| centre + side(c, 0) * x + side(c, 1) * y + side(c, 2) * z)
    }

    fn rests(&self, block: usize) -> bool {
        self.world.is_asleep(BodyId(block as u32))
    }

    fn work(&self) -> f64 {
        self.work
    }

    fn throw(&mut self, block: usize, velocity: DVec3) {
        self.world.set_twist(BodyId(block as u32), Twist::linear(velocity));
    }
}
