//! Simulator with its main loop, `JengaMain` (section 5.2).

use teeter_scene::{Scene, SceneError};

use super::collide::Collider;
use super::constants::Constants;
use super::contact::{Contact, FLOOR};
use super::counters::{Counters, StepCounts};
use super::create::create_block;
use super::disable::{self, Activity, RestDetector};
use super::field::Field;
use super::floor;
use super::forces::{Sources, compute_forces};
use super::hand::{Hand, UserForce};
use super::integrate::Integrator;
use super::model::Model;
use super::options::Disabling;
use super::particle::StateList;

/// Error of building a simulator.
///
/// ```
/// use teeter_dissertation::jenga3d::{BuildError, Constants, Jenga3D};
///
/// let scene = teeter_scene::named("block").expect("the list has it");
/// let error = Jenga3D::new(&scene, Constants { stiffness: -1.0, ..Constants::default() }).unwrap_err();
/// assert!(matches!(error, BuildError::Constant { field: "stiffness", .. }));
/// ```
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum BuildError {
    /// Invalid scene.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// Constant out of its range.
    #[error("`{field}` is {value}, expected {expected}")]
    Constant {
        /// Name of the constant.
        field: &'static str,
        /// Value found.
        value: f64,
        /// Range expected.
        expected: &'static str,
    },
}

/// Report of a frame.
///
/// ```
/// use teeter_dissertation::jenga3d::{Constants, Jenga3D};
///
/// let scene = teeter_scene::named("test-6").expect("the list has it");
/// let mut simulator = Jenga3D::new(&scene, Constants::default()).expect("a valid scene");
/// assert_eq!(simulator.frame(None).unresolved, 0);
/// ```
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct FrameReport {
    /// Counters of the last step.
    pub last: StepCounts,
    /// Counters of all steps.
    pub tests: Counters,
    /// Maximum number of rounds in a call of `CollideBlocks`.
    pub max_sweeps: u32,
    /// Number of rounds in all calls.
    pub sweeps: u64,
    /// Number of calls that ended with collisions left.
    pub unresolved: u32,
}

/// Three-dimensional simulator.
///
/// ```
/// use teeter_dissertation::jenga3d::{Constants, Jenga3D};
///
/// let scene = teeter_scene::named("test-1").expect("the list has it");
/// let mut simulator = Jenga3D::new(&scene, Constants::default()).expect("a valid scene");
/// let start = simulator.centres();
/// for _ in 0..30 {
///     simulator.frame(None);
/// }
/// assert!(simulator.centres().iter().zip(&start).all(|(now, was)| now.distance(*was) < 2e-3));
/// ```
#[derive(Debug, Clone)]
pub struct Jenga3D {
    /// Constants, which may change between frames.
    pub constants: Constants,
    /// Blocks and their parts.
    pub model: Model,
    /// Last valid states.
    pub curr: StateList,
    /// States to be made valid.
    pub next: StateList,
    /// Contacts of the previous step.
    pub contacts: Vec<Contact>,
    /// Simulated time, s.
    pub time: f64,
    integrator: Integrator,
    collider: Collider,
    rest: RestDetector,
    /// Number of steps since the last collision of each block.
    steps_since_contact: Vec<u32>,
}

impl Jenga3D {
    /// Creates the blocks of a scene, each row raised over the one below by the spacing of the
    /// constants. Friction and gravity are those of the constants, not of the scene.
    ///
    /// # Errors
    /// Names the invalid block and field of a scene, or the constant out of its range.
    pub fn new(scene: &Scene, constants: Constants) -> Result<Self, BuildError> {
        scene.validate()?;
        validate(&constants)?;
        let (mut model, mut curr) = (Model::default(), StateList::new());
        for block in &scene.blocks {
            let row = ((block.pos[2] - 0.5 * block.size[2]) / block.size[2]).round();
            create_block(&mut model, &mut curr, block, constants.row_spacing * (1.0 + row), &constants);
        }
        let rest = RestDetector::new(&model, &curr);
        let steps_since_contact = vec![u32::MAX; model.blocks.len()];
        let next = curr.clone();
        let integrator = Integrator::new(constants.scheme());
        Ok(Self {
            constants,
            model,
            curr,
            next,
            contacts: Vec::new(),
            time: 0.0,
            integrator,
            collider: Collider::default(),
            rest,
            steps_since_contact,
        })
    }

    /// Advances by one frame: `Loop` of Figure 5.2.
    pub fn frame(&mut self, hand: Option<&Hand>) -> FrameReport {
        let mut report = FrameReport::default();
        for _ in 0..self.constants.mid_loop_count {
            let counts = self.step(hand);
            report.max_sweeps = report.max_sweeps.max(counts.sweeps);
            report.sweeps += u64::from(counts.sweeps);
            report.unresolved += counts.unresolved;
            report.tests += counts.all;
            report.last = counts;
        }
        report
    }

    /// Advances by one step: integrates, resolves collisions and accepts the next states.
    pub fn step(&mut self, hand: Option<&Hand>) -> StepCounts {
        let user = hand.and_then(|hand| {
            let touching = self.steps_since_contact[hand.block as usize] <= self.constants.contact_memory;
            self.model.blocks[hand.block as usize].active = true;
            hand.act(&self.model, &self.constants, touching, &mut self.curr)
        });
        self.integrate(user);
        let counts = self.collision_phase(hand.map(|h| h.block));
        self.accept_next_state(hand.map(|h| h.block));
        self.time += self.constants.step();
        counts
    }

    /// Integrates from `curr` to `next` (appendix 2.1).
    fn integrate(&mut self, user: Option<UserForce>) {
        let Self { constants, model, curr, next, contacts, integrator, .. } = self;
        let sources = Sources { user, contacts, time: constants.force_step() };
        let forces = |states: &mut [_]| compute_forces(model, constants, &sources, states);
        integrator.scheme = constants.scheme();
        integrator.integrate(&model.particles, curr, next, forces);
        if constants.disabling == Disabling::Rigid {
            for block in model.blocks.iter().filter(|b| !b.active) {
                next[block.corners()].copy_from_slice(&curr[block.corners()]);
            }
        }
    }

    /// Resolves the collisions of `next` (appendix 2.4).
    fn collision_phase(&mut self, held: Option<u32>) -> StepCounts {
        let mut counts = StepCounts::default();
        self.contacts.clear(); // ClearFrictionList
        self.floor_collision();
        if self.constants.disabling != Disabling::Rigid {
            self.reactivate_all_blocks();
        }
        self.collider.begin(&self.model, &self.constants, &self.curr, &self.next);
        self.collide_blocks(&mut counts);
        if self.constants.disabling == Disabling::Listed {
            let disabled =
                disable::disable_motionless(&mut self.model, &self.constants, held, &self.curr, &mut self.next);
            for n in disabled {
                let corners = self.model.blocks[n].corners();
                self.collider.update_block(n, &self.curr[corners.clone()], &self.next[corners]);
            }
        }
        self.collide_blocks(&mut counts);
        counts
    }

    fn collide_blocks(&mut self, counts: &mut StepCounts) {
        let Self { constants, model, curr, next, contacts, collider, .. } = self;
        collider.collide(&mut Field { model, constants, curr, next, contacts }, counts);
    }

    fn floor_collision(&mut self) {
        let Self { constants, model, curr, next, contacts, .. } = self;
        let mut field = Field { model, constants, curr, next, contacts };
        for p in 0..field.curr.len() {
            let block = field.model.particles[p].block;
            if !field.model.blocks[block as usize].active {
                continue;
            }
            if let Some(contact) = floor::contact(p as u32, block, &field.next[p]) {
                field.respond(contact);
                // A particle that another block pushed below the floor has no displacement of its
                // own to reverse.
                let height = &mut field.next[p].position.z;
                *height = height.max(0.0);
            }
        }
    }

    fn reactivate_all_blocks(&mut self) {
        for block in &mut self.model.blocks {
            block.active = true;
        }
    }

    fn accept_next_state(&mut self, held: Option<u32>) {
        std::mem::swap(&mut self.curr, &mut self.next);
        for steps in &mut self.steps_since_contact {
            *steps = steps.saturating_add(1);
        }
        for contact in &self.contacts {
            for block in contact.blocks {
                if block != FLOOR {
                    self.steps_since_contact[block as usize] = 0;
                }
            }
        }
        if self.constants.disabling == Disabling::Rigid {
            let pairs: Vec<[u32; 2]> = self.contacts.iter().map(|c| c.blocks).filter(|b| b[1] != FLOOR).collect();
            let activity = Activity { held, neighbours: &pairs };
            self.rest.update(&mut self.model, &self.constants, activity, &mut self.curr);
        }
    }

    /// Sets the velocity (m/s) of all particles of a block and enables it.
    pub fn throw(&mut self, block: usize, velocity: glam::DVec3) {
        let corners = self.model.blocks[block].corners();
        for state in &mut self.curr[corners] {
            state.velocity = velocity;
        }
        self.model.blocks[block].active = true;
        self.rest.wake(block);
    }

    /// Positions of the centres of the blocks, m.
    pub fn centres(&self) -> Vec<glam::DVec3> {
        self.model.blocks.iter().map(|b| b.centre(&self.curr)).collect()
    }

    /// Height of the highest particle, m.
    pub fn top(&self) -> f64 {
        self.curr.iter().map(|s| s.position.z).fold(f64::NEG_INFINITY, f64::max)
    }
}

/// Rejects constants that a step cannot be computed with.
fn validate(c: &Constants) -> Result<(), BuildError> {
    let rules: [(&'static str, f64, bool, &'static str); 9] = [
        ("frame_rate", c.frame_rate, c.frame_rate > 0.0 && c.frame_rate.is_finite(), "a number above 0"),
        ("mid_loop_count", f64::from(c.mid_loop_count), c.mid_loop_count > 0, "at least 1"),
        ("iterations_per_frame", f64::from(c.iterations_per_frame), c.iterations_per_frame > 0, "at least 1"),
        ("gravity", c.gravity, c.gravity.is_finite(), "a number"),
        ("stiffness", c.stiffness, c.stiffness > 0.0 && c.stiffness.is_finite(), "a number above 0"),
        ("damping", c.damping, c.damping >= 0.0 && c.damping.is_finite(), "a number of at least 0"),
        ("restitution", c.restitution, (0.0..=1.0).contains(&c.restitution), "0 to 1"),
        ("friction", c.friction, c.friction >= 0.0 && c.friction.is_finite(), "a number of at least 0"),
        ("row_spacing", c.row_spacing, c.row_spacing >= 0.0 && c.row_spacing.is_finite(), "a number of at least 0"),
    ];
    match rules.into_iter().find(|(_, _, valid, _)| !valid) {
        Some((field, value, _, expected)) => Err(BuildError::Constant { field, value, expected }),
        None => Ok(()),
    }
}
