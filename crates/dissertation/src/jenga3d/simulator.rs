//! `JengaMain`: the simulator with its main loop (section 5.2).

use teeter_scene::{Scene, SceneError};

use super::block::create_block;
use super::collide::{Collider, Field};
use super::constants::Constants;
use super::contact::{Contact, FLOOR};
use super::counters::{Counters, StepCounts};
use super::disable::{self, Disabling, Watch};
use super::floor;
use super::forces::{Sources, compute_forces};
use super::hand::{Hand, UserForce};
use super::integrate::{Between, integrate};
use super::model::Model;
use super::particle::StateList;

/// Why there is no simulator.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum BuildError {
    /// The scene is not one that can be simulated.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// A constant is out of its range.
    #[error("`{field}` is {value}, expected {expected}")]
    Constant {
        /// Which one.
        field: &'static str,
        /// What it was.
        value: f64,
        /// What it should be.
        expected: &'static str,
    },
}

/// What a frame did.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct FrameReport {
    /// Tests of its last step.
    pub last: StepCounts,
    /// Tests of all its steps.
    pub tests: Counters,
    /// Most rounds that any call of `CollideBlocks` took.
    pub most_sweeps: u32,
    /// Rounds of all calls.
    pub sweeps: u64,
    /// Calls that ended with collisions left.
    pub unresolved: u32,
}

/// The 3-D simulator.
#[derive(Debug, Clone)]
pub struct Jenga3D {
    /// The constants; they may be changed between frames.
    pub constants: Constants,
    /// The blocks and their parts.
    pub model: Model,
    /// The last valid states.
    pub curr: StateList,
    /// The states that are being made valid.
    pub next: StateList,
    /// Contacts of the last step.
    pub contacts: Vec<Contact>,
    /// Simulated time, s.
    pub time: f64,
    between: Between,
    collider: Collider,
    watch: Watch,
    /// Steps since each block was last in a collision.
    untouched: Vec<u32>,
}

impl Jenga3D {
    /// The blocks of a scene, each row raised over the one below by the constants' spacing. Friction and gravity are the constants', not
    /// the scene's.
    ///
    /// # Errors
    /// When the scene is not valid, naming the block and field, or a constant is out of its range.
    pub fn new(scene: &Scene, constants: Constants) -> Result<Self, BuildError> {
        scene.validate()?;
        check(&constants)?;
        let (mut model, mut curr) = (Model::default(), StateList::new());
        for block in &scene.blocks {
            let row = ((block.pos[2] - 0.5 * block.size[2]) / block.size[2]).round();
            create_block(&mut model, &mut curr, block, constants.row_spacing * (1.0 + row), &constants);
        }
        let watch = Watch::new(&model, &curr);
        let untouched = vec![u32::MAX; model.blocks.len()];
        let next = curr.clone();
        Ok(Self {
            constants,
            model,
            curr,
            next,
            contacts: Vec::new(),
            time: 0.0,
            between: Between::default(),
            collider: Collider::default(),
            watch,
            untouched,
        })
    }

    /// One frame: `Loop` of Figure 5.2.
    pub fn frame(&mut self, hand: Option<&Hand>) -> FrameReport {
        let mut report = FrameReport::default();
        for _ in 0..self.constants.mid_loop_count {
            let counts = self.step(hand);
            report.most_sweeps = report.most_sweeps.max(counts.sweeps);
            report.sweeps += u64::from(counts.sweeps);
            report.unresolved += counts.unresolved;
            report.tests += counts.all;
            report.last = counts;
        }
        report
    }

    /// One round of integrating, colliding and accepting.
    pub fn step(&mut self, hand: Option<&Hand>) -> StepCounts {
        let user = hand.and_then(|hand| {
            let touching = self.untouched[hand.block as usize] <= self.constants.contact_memory;
            self.model.blocks[hand.block as usize].active = true;
            hand.act(&self.model, &self.constants, touching, &mut self.curr)
        });
        self.integrate(user);
        let counts = self.collision_phase(hand.map(|h| h.block));
        self.accept_next_state(hand.map(|h| h.block));
        self.time += self.constants.step();
        counts
    }

    /// From `curr` to `next` (appendix 2.1).
    fn integrate(&mut self, user: Option<UserForce>) {
        let Self { constants, model, curr, next, contacts, between, .. } = self;
        let sources = Sources { user, contacts, time: constants.force_step() };
        let forces = |states: &mut [_]| compute_forces(model, constants, &sources, states);
        integrate(
            constants.method,
            constants.iterations_per_frame,
            constants.step(),
            &model.particles,
            curr,
            next,
            between,
            forces,
        );
        if constants.disabling == Disabling::Rigid {
            for block in model.blocks.iter().filter(|b| !b.active) {
                next[block.corners()].copy_from_slice(&curr[block.corners()]);
            }
        }
    }

    /// Makes `next` valid (appendix 2.4).
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
                self.collider.touch(n, &self.curr[corners.clone()], &self.next[corners]);
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
                // What other blocks have pushed below the floor in the last step has no way back along its own.
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
        for n in &mut self.untouched {
            *n = n.saturating_add(1);
        }
        for contact in &self.contacts {
            for block in contact.blocks {
                if block != FLOOR {
                    self.untouched[block as usize] = 0;
                }
            }
        }
        if self.constants.disabling == Disabling::Rigid {
            let between: Vec<[u32; 2]> = self.contacts.iter().map(|c| c.blocks).filter(|b| b[1] != FLOOR).collect();
            self.watch.update(&mut self.model, &self.constants, held, &between, &mut self.curr);
        }
    }

    /// Gives all particles of a block a velocity, m/s, and enables it: how an experiment starts.
    pub fn throw(&mut self, block: usize, velocity: glam::DVec3) {
        let corners = self.model.blocks[block].corners();
        for state in &mut self.curr[corners] {
            state.velocity = velocity;
        }
        self.model.blocks[block].active = true;
        self.watch.wake(block);
    }

    /// Centres of the blocks, m.
    pub fn centres(&self) -> Vec<glam::DVec3> {
        self.model.blocks.iter().map(|b| b.centre(&self.curr)).collect()
    }

    /// Height of the highest particle, m.
    pub fn top(&self) -> f64 {
        self.curr.iter().map(|s| s.position.z).fold(f64::NEG_INFINITY, f64::max)
    }
}

/// Constants that a step could not be computed with are refused.
fn check(c: &Constants) -> Result<(), BuildError> {
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
    match rules.into_iter().find(|(_, _, holds, _)| !holds) {
        Some((field, value, _, expected)) => Err(BuildError::Constant { field, value, expected }),
        None => Ok(()),
    }
}
