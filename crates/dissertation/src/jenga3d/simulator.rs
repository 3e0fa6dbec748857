//! Simulator with its main loop, `JengaMain` (section 5.2).

use teeter_scene::{Scene, SceneError};

use super::block::CORNERS;
use super::collide::Collider;
use super::constant::ConstantError;
use super::constants::Constants;
use super::contact::{Contact, FLOOR};
use super::counters::{Counters, Rounds, StepCounts};
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
use super::stability;

/// Error of building a simulator.
///
/// ```
/// use teeter_dissertation::jenga3d::{BuildError, Constants, Jenga3D};
///
/// let scene = teeter_scene::named("block").expect("the list has it");
/// let error = Jenga3D::new(&scene, Constants { stiffness: -1.0, ..Constants::default() }).unwrap_err();
/// assert!(matches!(error, BuildError::Constant(_)));
/// assert_eq!(error.to_string(), "`stiffness` is -1, expected a number from 1 to 1e9 N/m");
/// ```
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum BuildError {
    /// Invalid scene.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// Constant out of its range, or that contradicts another.
    #[error(transparent)]
    Constant(#[from] ConstantError),
    /// Block that never moves, which the method does not have: only the floor is fixed.
    #[error("block {id}: `fixed` is true, expected false: the method of 2003 has no fixed blocks")]
    FixedBlock {
        /// Id of the block.
        id: u32,
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
    /// Sum over the steps of the maximum number of rounds in a call.
    pub sweeps: u64,
    /// Number of calls that ended with collisions left.
    pub unresolved: u32,
    /// Rounds of all calls.
    pub rounds: Rounds,
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
    /// Names the invalid block and field of a scene, a block that is fixed, or the constant that is
    /// out of its range or contradicts another.
    pub fn new(scene: &Scene, constants: Constants) -> Result<Self, BuildError> {
        scene.validate()?;
        if let Some(block) = scene.blocks.iter().find(|block| block.fixed) {
            return Err(BuildError::FixedBlock { id: block.id });
        }
        let min_mass = scene.blocks.iter().map(|block| block.mass).fold(f64::INFINITY, f64::min);
        constants.check_ranges()?;
        stability::check(&constants, min_mass / CORNERS as f64)?;
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
            report.rounds += counts.rounds;
            report.tests += counts.all;
            report.last = counts;
        }
        report.rounds.unresolved_frames = u64::from(report.unresolved > 0);
        report
    }

    /// Advances by a frame that covers `time` (s) in the steps of a frame: the adaptable frame rate
    /// of section 5.2.2, where `time` is that which the last frame took to compute.
    ///
    /// # Errors
    /// When the frame is shorter than a thousandth of a second or longer than a second, or the
    /// springs would diverge in steps so long: the stiff equations for which it was left out in
    /// 2003. [`Jenga3D::max_frame_time`] is the limit.
    pub fn frame_over(&mut self, time: f64, hand: Option<&Hand>) -> Result<FrameReport, ConstantError> {
        let default = self.constants.clone();
        self.set_constants(Constants { frame_rate: 1.0 / time, ..default.clone() })?;
        let report = self.frame(hand);
        self.constants = default;
        Ok(report)
    }

    /// Maximum time of a frame, s, at the present number of steps, for which no spring diverges.
    pub fn max_frame_time(&self) -> f64 {
        let min_mass = self.model.particles.iter().map(|p| p.mass).fold(f64::INFINITY, f64::min);
        stability::max_frame_time(&self.constants, min_mass)
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

    /// Checks that constants could replace the present ones.
    ///
    /// # Errors
    /// Names the constant out of its range, or that contradicts another.
    pub fn check_constants(&self, constants: &Constants) -> Result<(), ConstantError> {
        let min_mass = self.model.particles.iter().map(|p| p.mass).fold(f64::INFINITY, f64::min);
        constants.check_ranges()?;
        stability::check(constants, min_mass)
    }

    /// Replaces the constants, those of the springs included; the spacing of the rows belongs to
    /// the start and has no effect.
    ///
    /// # Errors
    /// Those of [`Jenga3D::check_constants`]; nothing is then changed.
    pub fn set_constants(&mut self, constants: Constants) -> Result<(), ConstantError> {
        self.check_constants(&constants)?;
        for spring in &mut self.model.springs {
            (spring.stiffness, spring.damping) = (constants.stiffness, constants.damping);
        }
        if constants.disabling != self.constants.disabling {
            self.reactivate_all_blocks();
            self.rest = RestDetector::new(&self.model, &self.curr);
        }
        self.constants = constants;
        Ok(())
    }

    /// Index of the first block with a position or velocity that is not finite.
    ///
    /// The checks of the constants exclude springs that diverge by themselves. They cannot exclude
    /// every interplay of springs, collisions and hand.
    pub fn first_non_finite(&self) -> Option<usize> {
        let finite = |p: usize| self.curr[p].position.is_finite() && self.curr[p].velocity.is_finite();
        self.model.blocks.iter().position(|block| !block.corners().all(finite))
    }

    /// Hash of positions, velocities and disabled blocks (XXH3, 64 bits): equal states have equal
    /// hashes on every target.
    pub fn hash(&self) -> u64 {
        let numbers = self.curr.iter().flat_map(|s| [s.position, s.velocity]).flat_map(|v| v.to_array());
        let mut bytes: Vec<u8> = numbers.flat_map(|x| x.to_bits().to_le_bytes()).collect();
        bytes.extend(self.model.blocks.iter().map(|block| u8::from(block.active)));
        xxhash_rust::xxh3::xxh3_64(&bytes)
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
