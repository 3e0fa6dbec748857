//! Binding of a game with Jenga3D: a command a frame, as in the engine's game.

#[cfg(test)]
mod tests;

use glam::{DQuat, DVec3};
use serde::Serialize;
use teeter_dissertation::jenga3d;
use teeter_dissertation::jenga3d::block::CORNERS;
use teeter_game::{BlockForm, Command, Game, Simulator, StepOutcome};
use teeter_physics::{BodyId, ContactReport, Hand, POSE_STRIDE};
use teeter_scene::Form;
use teeter_wasm_support::Error;
use wasm_bindgen::prelude::*;

use super::loads::LoadedContact;
use super::{Report, Space, settable_constants};

/// The hand of 2003 moves a block's centre. It is a spring while the block touches anything and
/// writes the block's velocity in the air, so only the lead of its target limits its force.
impl Simulator for Space {
    type Report = Report;

    fn len(&self) -> usize {
        self.length()
    }

    fn poses(&self) -> &[f64] {
        &self.views.poses
    }

    fn size(&self, body: BodyId) -> DVec3 {
        2.0 * self.views.halves[body.index()]
    }

    fn time(&self) -> f64 {
        self.jenga.time
    }

    fn frame(&self) -> f64 {
        1.0 / self.jenga.constants.frame_rate
    }

    fn step(&mut self, hand: Option<&Hand>) -> StepOutcome<Report> {
        let hand = hand.map(|hand| {
            let orientation = DQuat::from_slice(&self.views.poses[POSE_STRIDE * hand.body.index() + 3..]);
            jenga3d::Hand { block: hand.body.0, target: hand.target - orientation * hand.anchor }
        });
        let report = self.advance(hand.as_ref());
        let force = report.hand.as_ref().and_then(|hand| hand.force);
        StepOutcome { max_speed: report.max_speed, hand_force: force.map_or(DVec3::ZERO, DVec3::from), report }
    }

    fn contacts(&self, body: BodyId) -> Vec<ContactReport> {
        let contacts = self.loads.of_block(body.0, self.jenga.constants.mid_loop_count);
        let report = |LoadedContact { other, point, normal, force }| ContactReport {
            other: other.map(BodyId),
            point: DVec3::from(point),
            normal: DVec3::from(normal),
            force,
        };
        contacts.into_iter().map(report).collect()
    }

    fn particles(&self, body: BodyId) -> Option<[DVec3; CORNERS]> {
        let first = self.jenga.model.blocks[body.index()].corners().start;
        Some(std::array::from_fn(|corner| self.jenga.curr[first + corner].position))
    }

    /// The particles are the corners.
    fn particle_offset(&self) -> f64 {
        1.0
    }

    fn block_form(&self) -> BlockForm {
        BlockForm { form: Form::Lattice, spring_stiffness: self.jenga.constants.stiffness }
    }

    /// Stiffness of the springs within the blocks: the contacts have none.
    fn contact_stiffness(&self) -> f64 {
        self.jenga.constants.stiffness
    }

    fn check_block_form(&self, form: BlockForm) -> Result<(), String> {
        if form == self.block_form() { Ok(()) } else { Err("the springs of the 2003 blocks do not change".to_owned()) }
    }

    fn set_block_form(&mut self, form: BlockForm) -> Result<(), String> {
        self.check_block_form(form)
    }

    fn hand_can_turn(&self) -> bool {
        false
    }

    fn hand_stiffness(&self) -> Option<f64> {
        Some(self.jenga.constants.hand_stiffness)
    }

    fn held_by_itself(&self) -> Option<BodyId> {
        self.pointer_hand.block().map(BodyId)
    }
}

/// Game with the three-dimensional simulator of 2003.
///
/// ```
/// use teeter_museum::SpaceGame;
///
/// let scene = teeter_scene::named("column").expect("the list has it").to_json();
/// let mut game = SpaceGame::new(&scene, "{}").expect("a valid scene");
/// let update = game.step(r#"{"command": "place", "body": 1}"#).expect("a command");
/// assert!(update.contains("block 1 is not free"));
/// ```
#[wasm_bindgen]
#[derive(Debug)]
pub struct SpaceGame {
    game: Game<Space>,
    lattices: Vec<f32>,
}

#[wasm_bindgen]
impl SpaceGame {
    /// Creates the blocks of a scene (JSON) with constants (JSON, text by name). Friction and
    /// gravity are those of the scene unless they are named, all others have their defaults.
    ///
    /// # Errors
    /// Names the invalid block and field of the scene, or the constant that is not accepted.
    #[wasm_bindgen(constructor)]
    pub fn new(scene: &str, constants: &str) -> Result<SpaceGame, Error> {
        Ok(Self { game: Game::new(Space::new(scene, constants)?), lattices: Vec::new() })
    }

    /// Takes a request to the hand of 2003 (JSON), with which the next frame begins.
    ///
    /// `{"request": "pick" | "drag" | "resume", "pointer": {"origin", "direction",
    /// "toward_viewer"}}`, `{"request": "pull", "distance", "toward_viewer"}` or `{"request":
    /// "release"}`. That hand acts while the hand of the game holds nothing.
    ///
    /// # Errors
    /// When the text is no request; nothing is then changed.
    pub fn request(&self, request: &str) -> Result<(), Error> {
        self.game.world().request(request)
    }

    /// Takes constants (JSON, text by name), with which the next frame begins; the others keep
    /// their values.
    ///
    /// # Errors
    /// Names the constant that is not accepted; nothing is then changed.
    #[wasm_bindgen(js_name = setConstants)]
    pub fn set_constants(&self, constants: &str) -> Result<(), Error> {
        self.game.world().set_constants(constants)
    }

    /// Constants that can be set, as JSON: `[{"section", "name", "unit", "range", "meaning",
    /// "reason", "default"}]`.
    ///
    /// # Errors
    /// Never: the table is text and numbers.
    pub fn constants() -> Result<String, Error> {
        write("constants", &settable_constants())
    }

    /// Carries out a command (JSON of [`Command`]; empty text for `idle`), advances by 1/60 s and
    /// returns the update as JSON.
    ///
    /// # Errors
    /// When the text is no command; the state then stays unchanged.
    pub fn step(&mut self, command: &str) -> Result<String, Error> {
        let command = if command.trim().is_empty() {
            Command::Idle
        } else {
            serde_json::from_str(command).map_err(|e| Error::json("command", e))?
        };
        write("update", &self.game.step(&command))
    }

    /// Address of the poses in WebAssembly memory.
    ///
    /// Seven doubles a block: position (m) and orientation (x, y, z, w) of the rigid block nearest
    /// to the particles. Any later call may move them, so the view must be recreated.
    #[wasm_bindgen(js_name = posesPtr)]
    pub fn poses_ptr(&self) -> *const f64 {
        self.game.world().poses_ptr()
    }

    /// Writes the particles and springs of all blocks and returns their address in WebAssembly
    /// memory.
    ///
    /// 52 floats a block: positions of its 8 particles (m) and forces of its 28 springs (N, tension
    /// is positive; between particles 0 and 1, 0 and 2, ... 6 and 7). Bit k of a particle's number
    /// is its side along axis k of the block. Any later call may move them, so the view must be
    /// recreated.
    #[wasm_bindgen(js_name = latticesPtr)]
    pub fn lattices_ptr(&mut self) -> *const f32 {
        let Space { views, jenga, .. } = self.game.world();
        views.write_lattices(jenga, &mut self.lattices);
        self.lattices.as_ptr()
    }

    /// Number of blocks.
    #[wasm_bindgen(getter)]
    pub fn length(&self) -> usize {
        self.game.world().length()
    }

    /// Edge lengths of all blocks, three numbers each, m.
    pub fn sizes(&self) -> Vec<f32> {
        self.game.world().sizes()
    }

    /// Free slots for a block as JSON: `[{"row", "cell", "position", "orientation", "clearance"}]`.
    ///
    /// # Errors
    /// When the block does not exist.
    pub fn slots(&self, body: u32) -> Result<String, Error> {
        self.game.world().check(body)?;
        write("slots", &self.game.slots(BodyId(body)))
    }

    /// Loaded contacts of a block as means over the last frame, as JSON:
    /// `[{"other", "point", "normal", "force"}]`.
    ///
    /// # Errors
    /// When the block does not exist.
    pub fn contacts(&self, body: u32) -> Result<String, Error> {
        self.game.world().contacts(body)
    }

    /// Returns true if a block can be lifted: nothing is above it.
    ///
    /// # Errors
    /// When the block does not exist.
    #[wasm_bindgen(js_name = isFree)]
    pub fn is_free(&self, body: u32) -> Result<bool, Error> {
        self.game.world().check(body)?;
        Ok(self.game.is_free(BodyId(body)))
    }

    /// Returns true if the command to place a block, in the nearest slot, would be carried out.
    ///
    /// # Errors
    /// When the block does not exist.
    #[wasm_bindgen(js_name = canPlace)]
    pub fn can_place(&self, body: u32) -> Result<bool, Error> {
        self.game.world().check(body)?;
        Ok(self.game.can_place(BodyId(body)))
    }

    /// Simulated time, s.
    pub fn time(&self) -> f64 {
        self.game.world().jenga.time
    }

    /// Stiffness of the hand, N/m.
    #[wasm_bindgen(getter, js_name = handStiffness)]
    pub fn hand_stiffness(&self) -> f64 {
        self.game.world().hand_stiffness()
    }
}

fn write(subject: &'static str, value: &impl Serialize) -> Result<String, Error> {
    serde_json::to_string(value).map_err(|e| Error::json(subject, e))
}
