//! Binding of Jenga3D, a frame at a time.

mod game;
mod loads;
mod pointer_hand;
#[cfg(test)]
mod tests;
mod views;

use std::cell::RefCell;
use std::collections::BTreeMap;

use glam::DVec3;
use serde::{Deserialize, Serialize};
use teeter_dissertation::jenga3d::counters::Counters;
use teeter_dissertation::jenga3d::{Constant, Constants, Hand, HandMode, Jenga3D, TABLE};
use teeter_scene::Scene;
use teeter_wasm_support::Error;

pub use game::SpaceGame;
use loads::Loads;
use pointer_hand::{PointerHand, Request};
use views::Views;

/// Three-dimensional simulator of 2003.
///
/// ```
/// use teeter_museum::Space;
///
/// let scene = teeter_scene::named("column").expect("the list has it").to_json();
/// let mut space = Space::new(&scene, "{}").expect("a valid scene");
/// let report = space.step(r#"{"body": 9, "target": [0, 0, 0.3]}"#).expect("a valid hand");
/// assert!(report.contains("\"active\":"));
/// ```
#[derive(Debug)]
pub struct Space {
    jenga: Jenga3D,
    views: Views,
    lattices: Vec<f32>,
    /// Loads of the contacts in the last frame.
    loads: Loads,
    /// Hand of 2003, which holds a block by itself.
    pointer_hand: PointerHand,
    /// Changes by the player, with which the next frame begins.
    changes: RefCell<Vec<Change>>,
}

/// Change by the player between two frames.
#[derive(Debug)]
enum Change {
    /// Request to the hand of 2003.
    Hand(Request),
    /// New constants.
    Constants(Box<Constants>),
}

/// Constants that the page does not set: its frames cover 1/60 s.
const FIXED: [&str; 1] = ["frame_rate"];

/// Command of the hand.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct HandCommand {
    body: u32,
    /// Target of the block's centre, m.
    target: [f64; 3],
}

/// Report of a frame.
#[derive(Debug, Serialize)]
pub struct Report {
    /// Simulated time, s.
    time: f64,
    /// Number of blocks that are not disabled.
    active: usize,
    /// Number of pairs of blocks that collided.
    touching: usize,
    /// Velocity of the fastest block, m/s.
    max_speed: f64,
    /// Maximum number of rounds over the pairs in a step.
    rounds: u32,
    /// Number of calls that ended with collisions left.
    unresolved: u32,
    /// Tests of the last step.
    tests: Counters,
    hand: Option<HandReport>,
    /// Indices of the disabled blocks.
    disabled: Vec<u32>,
}

/// Report of the hand at the end of a frame.
#[derive(Debug, Serialize)]
struct HandReport {
    /// Index of its block.
    body: u32,
    /// Target of the block's centre, m.
    target: [f64; 3],
    /// Force, N; `None` while the hand writes the velocity, which no force limits.
    force: Option<[f64; 3]>,
}

impl Space {
    /// Creates the blocks of a scene (JSON) with constants (JSON, text by name). Friction and
    /// gravity are those of the scene unless they are named, all others have their defaults.
    ///
    /// # Errors
    /// Names the invalid block and field of the scene, or the constant that is not accepted.
    pub fn new(scene: &str, constants: &str) -> Result<Space, Error> {
        let scene = Scene::from_json(scene).map_err(Error::rejected)?;
        let default = Constants { friction: scene.friction, gravity: scene.gravity, ..Constants::default() };
        let jenga = Jenga3D::new(&scene, read_constants(constants, default)?).map_err(Error::rejected)?;
        let halves = scene.blocks.iter().map(|b| 0.5 * DVec3::from(b.size)).collect();
        let views = Views::new(&jenga, halves);
        Ok(Self {
            jenga,
            views,
            lattices: Vec::new(),
            loads: Loads::default(),
            pointer_hand: PointerHand::default(),
            changes: RefCell::default(),
        })
    }

    /// Advances by 1/60 s under a hand and returns the report as JSON.
    ///
    /// The hand is JSON, `{"body", "target"}` with the target of the block's centre in m, or empty
    /// text.
    ///
    /// # Errors
    /// When the hand is invalid or its block does not exist; the state then stays unchanged.
    pub fn step(&mut self, hand: &str) -> Result<String, Error> {
        let command: Option<HandCommand> = if hand.trim().is_empty() {
            None
        } else {
            Some(serde_json::from_str(hand).map_err(|e| Error::json("hand", e))?)
        };
        if let Some(command) = &command {
            self.check(command.body)?;
            if !command.target.iter().all(|x| x.is_finite()) {
                return Err(Error::rejected("hand: `target` is not a finite position"));
            }
        }
        let hand = command.map(|c| Hand { block: c.body, target: c.target.into() });
        let report = self.advance(hand.as_ref());
        serde_json::to_string(&report).map_err(|e| Error::json("report", e))
    }

    /// Address of the poses in WebAssembly memory.
    ///
    /// Seven doubles a block: position (m) and orientation (x, y, z, w) of the rigid block nearest
    /// to the particles. Any later call may move them, so the view must be recreated.
    pub fn poses_ptr(&self) -> *const f64 {
        self.views.poses.as_ptr()
    }

    /// Writes the particles and springs of all blocks and returns their address in WebAssembly
    /// memory.
    ///
    /// 52 floats a block: positions of its 8 particles (m) and forces of its 28 springs (N, tension
    /// is positive; between particles 0 and 1, 0 and 2, ... 6 and 7). Bit k of a particle's number
    /// is its side along axis k of the block. Any later call may move them, so the view must be
    /// recreated.
    pub fn lattices_ptr(&mut self) -> *const f32 {
        self.views.write_lattices(&self.jenga, &mut self.lattices);
        self.lattices.as_ptr()
    }

    /// Number of blocks.
    pub fn length(&self) -> usize {
        self.views.halves.len()
    }

    /// Edge lengths of all blocks, three numbers each, m.
    pub fn sizes(&self) -> Vec<f32> {
        self.views.halves.iter().flat_map(|half| (2.0 * half).as_vec3().to_array()).collect()
    }

    /// Loaded contacts of a block as means over the last frame, as JSON:
    /// `[{"other", "point", "normal", "force"}]`.
    ///
    /// # Errors
    /// When the block does not exist.
    pub fn contacts(&self, body: u32) -> Result<String, Error> {
        self.check(body)?;
        let contacts = self.loads.of_block(body, self.jenga.constants.mid_loop_count);
        serde_json::to_string(&contacts).map_err(|e| Error::json("contacts", e))
    }

    /// Simulated time, s.
    pub fn time(&self) -> f64 {
        self.jenga.time
    }

    /// Stiffness of the hand, N/m.
    pub fn hand_stiffness(&self) -> f64 {
        self.jenga.constants.hand_stiffness
    }
}

impl Space {
    fn check(&self, body: u32) -> Result<(), Error> {
        let count = self.length();
        if (body as usize) < count {
            Ok(())
        } else {
            Err(Error::rejected(format!("there is no block {body}: the tower has {count}")))
        }
    }

    /// Takes a request to the hand of 2003 (JSON of [`Request`]) for the next frame.
    fn request(&self, request: &str) -> Result<(), Error> {
        let request: Request = serde_json::from_str(request).map_err(|e| Error::json("request", e))?;
        if !request.is_valid() {
            return Err(Error::rejected("request: a direction has no length, or a number is not finite"));
        }
        self.changes.borrow_mut().push(Change::Hand(request));
        Ok(())
    }

    /// Takes constants (JSON, text by name) for the next frame; the others keep their values.
    ///
    /// The text is checked against the blocks now, so that the next frame can begin with it.
    fn set_constants(&self, constants: &str) -> Result<(), Error> {
        let mut changes = self.changes.borrow_mut();
        let pending = changes.iter().rev().find_map(|change| match change {
            Change::Constants(constants) => Some((**constants).clone()),
            Change::Hand(_) => None,
        });
        let constants = read_constants(constants, pending.unwrap_or_else(|| self.jenga.constants.clone()))?;
        self.jenga.check_constants(&constants).map_err(Error::rejected)?;
        changes.push(Change::Constants(Box::new(constants)));
        Ok(())
    }

    /// Begins a frame with the changes of the player.
    fn apply_changes(&mut self) {
        for change in self.changes.take() {
            match change {
                Change::Hand(request) => self.pointer_hand.take(&request, &self.jenga),
                Change::Constants(constants) => {
                    self.jenga.set_constants(*constants).expect("constants are checked when they are taken");
                }
            }
        }
    }

    fn advance(&mut self, hand: Option<&Hand>) -> Report {
        self.apply_changes();
        let own = if hand.is_none() { self.pointer_hand.hand(&self.jenga) } else { None };
        let hand = hand.or(own.as_ref());
        self.loads.clear();
        let (mut rounds, mut unresolved, mut tests) = (0, 0, Counters::default());
        for _ in 0..self.jenga.constants.mid_loop_count {
            let counts = self.jenga.step(hand);
            rounds = rounds.max(counts.sweeps);
            unresolved += counts.unresolved;
            tests = counts.first;
            self.loads.add(&self.jenga);
        }
        self.views.update_poses(&self.jenga);
        let Jenga3D { model, curr, time, .. } = &self.jenga;
        Report {
            time: *time,
            active: model.blocks.iter().filter(|b| b.active).count(),
            touching: self.loads.touching_blocks(),
            max_speed: model.blocks.iter().map(|b| b.velocity(curr).length()).fold(0.0, f64::max),
            rounds,
            unresolved,
            tests,
            hand: hand.map(|hand| HandReport {
                body: hand.block,
                target: hand.target.to_array(),
                force: self.hand_force(hand).map(|f| f.to_array()),
            }),
            disabled: (0..).zip(&model.blocks).filter(|(_, block)| !block.active).map(|(n, _)| n).collect(),
        }
    }

    /// Force of the hand on its block, N; `None` while it writes the velocity.
    fn hand_force(&self, hand: &Hand) -> Option<DVec3> {
        let Jenga3D { model, curr, constants, .. } = &self.jenga;
        let by_force = match constants.hand {
            HandMode::Force => true,
            HandMode::Velocity => false,
            HandMode::Hybrid => self.loads.is_touching(hand.block),
        };
        by_force.then(|| constants.hand_stiffness * (hand.target - model.blocks[hand.block as usize].centre(curr)))
    }
}

/// Constants that a page can set, as data: section, name, unit, range, meaning, reason, and the
/// default.
pub fn settable_constants() -> Vec<&'static Constant> {
    TABLE.iter().filter(|constant| !FIXED.contains(&constant.name)).collect()
}

/// Sets the constants that a text (JSON, text by name) names.
fn read_constants(text: &str, mut constants: Constants) -> Result<Constants, Error> {
    let values: BTreeMap<String, String> = serde_json::from_str(text).map_err(|e| Error::json("constants", e))?;
    for (name, value) in &values {
        if FIXED.contains(&name.as_str()) {
            return Err(Error::rejected(format!("`{name}` is that of the page")));
        }
        constants.set(name, value).map_err(Error::rejected)?;
    }
    Ok(constants)
}
