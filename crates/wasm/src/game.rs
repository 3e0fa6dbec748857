//! Binding of a game: commands and updates as JSON, poses as a view on wasm memory.

use teeter_game::{Command, Record, RecordWriter, Rules, Table, save_world};
use teeter_physics::{BodyId, Params, World};
use teeter_scene::{Form, Scene};
use wasm_bindgen::prelude::*;

use crate::text::{read, write};
use crate::{Error, views};

/// A game that a worker owns and steps.
#[wasm_bindgen]
#[derive(Debug)]
pub struct Game {
    game: teeter_game::Game,
    /// None where the game is not recorded.
    writer: Option<RecordWriter>,
    lattices: Vec<f32>,
}

#[wasm_bindgen]
impl Game {
    /// Builds a game from a scene (JSON), the constants of the run (JSON of [`Params`]; empty text
    /// for the defaults) and rules (JSON of [`Rules`]; free play where absent or empty).
    #[wasm_bindgen(constructor)]
    pub fn new(scene: &str, params: &str, rules: Option<String>) -> Result<Game, Error> {
        let scene = Scene::from_json(scene).map_err(Error::rejected)?;
        let params: Params = read("parameters", params)?;
        let rules: Rules = read("rules", rules.as_deref().unwrap_or_default())?;
        let world = World::new(&scene, params).map_err(Error::rejected)?;
        let game = teeter_game::Game::with_rules(world, rules).map_err(Error::rejected)?;
        Ok(Self { game, writer: None, lattices: Vec::new() })
    }

    /// Rules of a table (its name, such as `official`) for a number of players, as JSON.
    pub fn rules(table: &str, players: u32) -> Result<String, Error> {
        let table: Table = serde_json::from_value(table.into()).map_err(|e| Error::json("table", e))?;
        write("rules", &Rules::of(table, players))
    }

    /// Begins to record the game, before its first frame. A state that is restored ends it.
    #[wasm_bindgen(js_name = startRecord)]
    pub fn start_record(&mut self) -> Result<(), Error> {
        let world = self.game.world();
        if world.time() > 0.0 {
            return Err(Error::rejected("a game is recorded from its first frame on"));
        }
        self.writer = Some(RecordWriter::new(world.scene(), *world.params(), self.game.rules()));
        Ok(())
    }

    /// Record of the game so far as bytes; undefined where it is not recorded. With its state it is
    /// larger, and resumed at once.
    pub fn record(&self, with_state: Option<bool>) -> Option<Vec<u8>> {
        let writer = self.writer.clone()?;
        let with_state = with_state == Some(true);
        let record = if with_state { writer.finish_with_state(&self.game) } else { writer.finish(&self.game) };
        Some(record.encode())
    }

    /// Goes on with a recorded game where its record ends, and with the record. Bytes that are none
    /// are an error, and so is the record of a game that this engine computes otherwise.
    pub fn resume(record: &[u8]) -> Result<Game, Error> {
        let record = Record::decode(record).map_err(Error::rejected)?;
        let (game, writer) = teeter_game::resume(record).map_err(Error::rejected)?;
        Ok(Self { game, writer: Some(writer), lattices: Vec::new() })
    }

    /// Scene of the blocks as they stand now (JSON).
    pub fn scene(&self) -> String {
        self.game.world().to_scene().to_json()
    }

    /// Rules of the game (JSON of [`Rules`]).
    #[wasm_bindgen(js_name = ownRules)]
    pub fn own_rules(&self) -> Result<String, Error> {
        write("rules", &self.game.rules())
    }

    /// Judges a command (JSON of [`Command`]) by the rules. Returns the reason why it is illegal;
    /// undefined where it is not.
    pub fn judge(&self, command: &str) -> Result<Option<String>, Error> {
        let command: Command = read("command", command)?;
        Ok(self.game.judge(&command).err().map(|rule| rule.to_string()))
    }

    /// Carries out a command (JSON of [`Command`]; empty text for `idle`), advances by a frame and
    /// returns the update as JSON. Text that is no command is an error, and the game stays as it
    /// was.
    pub fn step(&mut self, command: &str) -> Result<String, Error> {
        let command: Command = read("command", command)?;
        let update = self.game.step(&command);
        // A game of more than a day goes on without its record.
        self.writer.take_if(|writer| writer.write(&command, &self.game).is_err());
        write("update", &update)
    }

    /// Address of the poses in wasm memory: seven doubles a body, position (m) and orientation (x,
    /// y, z, w). Any later call may move them, so each view is made again.
    #[wasm_bindgen(js_name = posesPtr)]
    pub fn poses_ptr(&self) -> *const f64 {
        self.game.world().poses().as_ptr()
    }

    /// Number of bodies.
    #[wasm_bindgen(getter)]
    pub fn length(&self) -> usize {
        self.game.world().len()
    }

    /// Edge lengths of all bodies, three numbers each, m.
    pub fn sizes(&self) -> Vec<f64> {
        views::sizes(self.game.world())
    }

    /// Address in wasm memory of the particles and springs of all bodies, written by this call: 52
    /// floats a body, the positions of its 8 particles (m, in the world) and the forces of its 28
    /// springs (N, tension is positive; between particles 0 and 1, 0 and 2, ... 6 and 7). Bit k of
    /// a particle's number says on which side of axis k of the block it is. Nothing where the
    /// blocks are rigid. Any later call may move them.
    #[wasm_bindgen(js_name = latticesPtr)]
    pub fn lattices_ptr(&mut self) -> *const f32 {
        views::write_lattices(self.game.world(), &mut self.lattices);
        self.lattices.as_ptr()
    }

    /// Free slots for a body as JSON: `[{"row", "cell", "position", "orientation", "clearance"}]`.
    pub fn slots(&self, body: u32) -> Result<String, Error> {
        let body = self.check(body)?;
        write("slots", &self.game.slots(body))
    }

    /// Loaded contacts of a body as JSON: `[{"other", "point", "normal", "force"}]`.
    pub fn contacts(&self, body: u32) -> Result<String, Error> {
        let body = self.check(body)?;
        write("contacts", &self.game.world().contacts(body))
    }

    /// Returns true if a body can be lifted: nothing is above it.
    #[wasm_bindgen(js_name = isFree)]
    pub fn is_free(&self, body: u32) -> Result<bool, Error> {
        let body = self.check(body)?;
        Ok(self.game.is_free(body))
    }

    /// Returns true if the command to place a body, in the nearest slot, would be carried out.
    #[wasm_bindgen(js_name = canPlace)]
    pub fn can_place(&self, body: u32) -> Result<bool, Error> {
        let body = self.check(body)?;
        Ok(self.game.can_place(body))
    }

    /// Returns true if a body sleeps.
    pub fn asleep(&self, body: u32) -> Result<bool, Error> {
        let body = self.check(body)?;
        Ok(self.game.world().is_asleep(body))
    }

    /// Load and tightness of each body from the contacts of the moment, two numbers a body: the
    /// normal force on its upper face and the force that starts it sliding straight, N. The second
    /// is not a number where nothing bears the body. Of meaning at rest only.
    pub fn xray(&self) -> Vec<f64> {
        let world = self.game.world();
        views::loads(world, world.scene().friction)
    }

    /// Hash of the world's state, 16 hexadecimal digits: that of a world stepped with the same
    /// hands.
    pub fn hash(&self) -> String {
        format!("{:016x}", self.game.hash())
    }

    /// State of the game as bytes.
    pub fn snapshot(&self) -> Vec<u8> {
        self.game.snapshot()
    }

    /// Takes over a state of a game of the same scene and constants. Bytes that are none leave the
    /// game as it was.
    pub fn restore(&mut self, bytes: &[u8]) -> Result<(), Error> {
        self.game.restore(bytes).map_err(Error::rejected)?;
        self.writer = None;
        Ok(())
    }

    /// The world of this moment as bytes, with its scene and constants: what `Thought` and
    /// `TowerAnalysis` begin with in another worker.
    pub fn world(&self) -> Vec<u8> {
        save_world(self.game.world())
    }

    /// Simulated time, s.
    pub fn time(&self) -> f64 {
        self.game.world().time()
    }

    /// Stiffness of the contacts, N/m.
    #[wasm_bindgen(getter)]
    pub fn stiffness(&self) -> f64 {
        self.game.world().stiffness()
    }

    /// Form of the blocks: `rigid` or `lattice`.
    #[wasm_bindgen(getter)]
    pub fn form(&self) -> String {
        self.game.world().form().to_string()
    }

    /// Stiffness of the springs within the blocks, N/m; undefined where they are rigid.
    #[wasm_bindgen(getter, js_name = springStiffness)]
    pub fn spring_stiffness(&self) -> Option<f64> {
        self.game.world().spring_stiffness().filter(|_| self.game.world().form() == Form::Lattice)
    }
}

impl Game {
    /// A game that is recorded.
    pub(crate) fn of(game: teeter_game::Game, writer: RecordWriter) -> Self {
        Self { game, writer: Some(writer), lattices: Vec::new() }
    }

    /// The game.
    pub(crate) fn inner(&self) -> &teeter_game::Game {
        &self.game
    }

    fn check(&self, body: u32) -> Result<BodyId, Error> {
        let count = self.length();
        let unknown = || Error::rejected(format!("there is no body {body}: the world has {count}"));
        self.game.world().body(body).ok_or_else(unknown)
    }
}

#[cfg(test)]
mod tests {
    use serde_json::Value;

    use super::*;

    fn game() -> Game {
        Game::new(&crate::tower_scene(r#"{"rows": 3}"#).unwrap(), "", None).unwrap()
    }

    #[test]
    fn commands_and_updates_are_text() {
        let mut game = game();
        let update: Value = serde_json::from_str(&game.step("").unwrap()).unwrap();
        assert_eq!((&update["tower"], &update["form"]), (&"standing".into(), &"rigid".into()));
        assert!(update["spring_stiffness"].is_null() && update["report"]["max_speed"].is_number());
        let top = r#"{"command": "grasp", "body": 7, "anchor": [0, 0, 0.009], "normal": [0, 0, 1], "grip": "auto"}"#;
        let update: Value = serde_json::from_str(&game.step(top).unwrap()).unwrap();
        assert_eq!((&update["hand"]["body"], &update["hand"]["grip"]), (&7.into(), &"carry".into()));
        assert_eq!(update["slots"].as_array().unwrap().len(), 1);
    }

    #[test]
    fn text_that_is_no_command_is_an_error_of_one_line_and_changes_nothing() {
        let mut game = game();
        for text in
            ["{", "[]", "grasp", r#"{"command": "jump"}"#, r#"{"command": "move"}"#, r#"{"command": "place", "x": 1}"#]
        {
            let line = game.step(text).unwrap_err().to_string();
            assert!(line.starts_with("command: ") && !line.contains('\n'), "{line}");
        }
        assert_eq!(game.time(), 0.0);
        for error in [game.slots(9).map(drop), game.contacts(9).map(drop), game.is_free(9).map(drop)] {
            assert_eq!(error.unwrap_err().to_string(), "there is no body 9: the world has 9");
        }
    }

    #[test]
    fn a_game_by_rules_says_whose_turn_it_is_and_its_record_replays_the_same() {
        let scene = crate::tower_scene(r#"{"rows": 3}"#).unwrap();
        let rules = Game::rules("official", 2).unwrap();
        let mut game = Game::new(&scene, "", Some(rules)).unwrap();
        assert_eq!(game.record(None), None);
        game.start_record().unwrap();
        let update: Value = serde_json::from_str(&game.step("").unwrap()).unwrap();
        assert_eq!((&update["turn"]["phase"], &update["turn"]["player"]), (&"choosing".into(), &0.into()));
        let top = r#"{"command": "grasp", "body": 7, "anchor": [0, 0, 0.009], "normal": [0, 0, 1], "grip": "auto"}"#;
        let reason = game.judge(top).unwrap().unwrap();
        let update: Value = serde_json::from_str(&game.step(top).unwrap()).unwrap();
        assert_eq!(
            (&update["events"][0]["event"], &update["events"][0]["reason"]),
            (&"illegal".into(), &reason.into())
        );
        let record = teeter_game::Record::decode(&game.record(None).unwrap()).unwrap();
        let verified = teeter_game::verify(&record).unwrap();
        assert_eq!((record.frames(), verified.same, format!("{:016x}", verified.hash)), (2, true, game.hash()));
        assert_eq!(game.start_record().unwrap_err().to_string(), "a game is recorded from its first frame on");
    }

    #[test]
    fn a_game_is_resumed_from_its_record_with_the_same_state_and_record() {
        let scene = crate::tower_scene(r#"{"rows": 3}"#).unwrap();
        let mut game = Game::new(&scene, "", Some(Game::rules("dissertation", 2).unwrap())).unwrap();
        game.start_record().unwrap();
        let top = r#"{"command": "grasp", "body": 7, "anchor": [0, 0, 0.009], "normal": [0, 0, 1], "grip": "auto"}"#;
        (0..80).for_each(|k| drop(game.step(if k == 20 { top } else { "" }).unwrap()));
        let mut resumed = Game::resume(&game.record(Some(true)).unwrap()).unwrap();
        assert_eq!((resumed.time(), resumed.hash()), (game.time(), game.hash()));
        assert_eq!(resumed.own_rules().unwrap(), Game::rules("dissertation", 2).unwrap());
        for _ in 0..50 {
            assert_eq!(resumed.step("").unwrap(), game.step("").unwrap());
        }
        assert_eq!(resumed.record(None), game.record(None));
        let line = Game::resume(b"none").unwrap_err().to_string();
        assert!(!line.is_empty() && !line.contains('\n'), "{line}");
    }

    #[test]
    fn the_scene_of_a_game_is_its_blocks_as_they_stand() {
        let mut game = game();
        (0..10).for_each(|_| drop(game.step("").unwrap()));
        let scene: Value = serde_json::from_str(&game.scene()).unwrap();
        let heights = scene["blocks"].as_array().unwrap().iter().map(|block| block["pos"][2].as_f64().unwrap());
        let poses = game.game.world().poses().chunks_exact(7).map(|pose| pose[2]);
        assert!(heights.zip(poses).all(|(height, z)| (height - z).abs() < 1e-9));
    }

    #[test]
    fn rules_that_are_none_are_an_error_of_one_line() {
        let scene = crate::tower_scene(r#"{"rows": 3}"#).unwrap();
        for rules in ["{", r#"{"table": "official"}"#, &Game::rules("official", 9).unwrap()] {
            let line = Game::new(&scene, "", Some(rules.to_owned())).unwrap_err().to_string();
            assert!(!line.is_empty() && !line.contains('\n'), "{line}");
        }
        assert!(Game::rules("chess", 2).is_err());
    }
}
