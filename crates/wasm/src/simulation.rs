//! Binding of a world: inputs and reports as JSON, poses as a view on wasm memory.

use serde::Deserialize;
use teeter_physics::{BodyId, Input, Params, World};
use teeter_scene::{Form, Scene, Springs};
use wasm_bindgen::prelude::*;

use crate::{Error, views};

/// A world that a worker owns and steps.
#[wasm_bindgen]
#[derive(Debug)]
pub struct Simulation {
    world: World,
    /// Coefficient of static friction.
    friction: f64,
    lattices: Vec<f32>,
}

#[wasm_bindgen]
impl Simulation {
    /// Builds a world from a scene (JSON) and the constants of the run (JSON of [`Params`]; empty
    /// text for the defaults).
    #[wasm_bindgen(constructor)]
    pub fn new(scene: &str, params: &str) -> Result<Simulation, Error> {
        let scene = Scene::from_json(scene).map_err(Error::rejected)?;
        let params: Params = if params.trim().is_empty() {
            Params::default()
        } else {
            serde_json::from_str(params).map_err(|e| Error::json("parameters", e))?
        };
        let world = World::new(&scene, params).map_err(Error::rejected)?;
        Ok(Self { world, friction: scene.friction, lattices: Vec::new() })
    }

    /// Advances by a frame under `input` (JSON of [`Input`]; empty text for none) and returns the
    /// report as JSON.
    ///
    /// A hand, force or drive on a body that does not exist is an error, and the world stays as it
    /// was.
    pub fn step(&mut self, input: &str) -> Result<String, Error> {
        let input: Input = if input.trim().is_empty() {
            Input::default()
        } else {
            serde_json::from_str(input).map_err(|e| Error::json("input", e))?
        };
        let bodies = input
            .hand
            .iter()
            .map(|h| h.body)
            .chain(input.forces.iter().map(|f| f.body))
            .chain(input.drives.iter().map(|d| d.body));
        for body in bodies {
            self.check(body.0)?;
        }
        let report = self.world.step(&input);
        serde_json::to_string(&report).map_err(|e| Error::json("report", e))
    }

    /// Address of the poses in wasm memory: seven doubles a body, position (m) and orientation (x,
    /// y, z, w). Any later call may move them, so each view is made again.
    #[wasm_bindgen(js_name = posesPtr)]
    pub fn poses_ptr(&self) -> *const f64 {
        self.world.poses().as_ptr()
    }

    /// Number of bodies.
    #[wasm_bindgen(getter)]
    pub fn length(&self) -> usize {
        self.world.len()
    }

    /// Edge lengths of all bodies, three numbers each, m.
    pub fn sizes(&self) -> Vec<f64> {
        views::sizes(&self.world)
    }

    /// Loaded contacts of a body as JSON: `[{"other", "point", "normal", "force"}]`.
    pub fn contacts(&self, body: u32) -> Result<String, Error> {
        let body = self.check(body)?;
        serde_json::to_string(&self.world.contacts(body)).map_err(|e| Error::json("contacts", e))
    }

    /// Returns true if a body sleeps.
    pub fn asleep(&self, body: u32) -> Result<bool, Error> {
        let body = self.check(body)?;
        Ok(self.world.is_asleep(body))
    }

    /// Hash of the state, 16 hexadecimal digits.
    pub fn hash(&self) -> String {
        format!("{:016x}", self.world.hash())
    }

    /// State as bytes.
    pub fn snapshot(&self) -> Vec<u8> {
        self.world.snapshot()
    }

    /// Takes over a state of the same scene and constants. Bytes that are none leave the world as
    /// it was.
    pub fn restore(&mut self, bytes: &[u8]) -> Result<(), Error> {
        self.world.restore(bytes).map_err(Error::rejected)
    }

    /// Stiffness of the contacts, N/m.
    #[wasm_bindgen(getter)]
    pub fn stiffness(&self) -> f64 {
        self.world.stiffness()
    }

    /// Form of the blocks: `rigid` or `lattice`.
    #[wasm_bindgen(getter)]
    pub fn form(&self) -> String {
        self.world.form().to_string()
    }

    /// Stiffness of the springs within the blocks, N/m; undefined where they are rigid.
    #[wasm_bindgen(getter, js_name = springStiffness)]
    pub fn spring_stiffness(&self) -> Option<f64> {
        self.world.spring_stiffness()
    }

    /// Gives the blocks another form (JSON of `{"form", "springs"}` as in a scene) with their poses
    /// and velocities. A form that is refused leaves the world as it was.
    #[wasm_bindgen(js_name = setForm)]
    pub fn set_form(&mut self, form: &str) -> Result<(), Error> {
        let Blocks { form, springs } = serde_json::from_str(form).map_err(|e| Error::json("form", e))?;
        self.world.set_form(form, springs).map_err(Error::rejected)
    }

    /// Address in wasm memory of the particles and springs of all bodies, written by this call: 52
    /// floats a body, the positions of its 8 particles (m, in the world) and the forces of its 28
    /// springs (N, tension is positive; between particles 0 and 1, 0 and 2, ... 6 and 7). Bit k of
    /// a particle's number says on which side of axis k of the block it is. Nothing where the
    /// blocks are rigid. Any later call may move them, so each view is made again.
    #[wasm_bindgen(js_name = latticesPtr)]
    pub fn lattices_ptr(&mut self) -> *const f32 {
        views::write_lattices(&self.world, &mut self.lattices);
        self.lattices.as_ptr()
    }

    /// Load and tightness of each body from the contacts of the moment, two numbers a body: the
    /// normal force on its upper face and the force that starts it sliding straight, N. The second
    /// is not a number where nothing bears the body. Of meaning at rest only: blows count too.
    pub fn xray(&self) -> Vec<f64> {
        views::loads(&self.world, self.friction)
    }

    /// Simulated time, s.
    pub fn time(&self) -> f64 {
        self.world.time()
    }

    fn check(&self, body: u32) -> Result<BodyId, Error> {
        let unknown = || Error::rejected(format!("there is no body {body}: the world has {}", self.world.len()));
        self.world.body(body).ok_or_else(unknown)
    }
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Blocks {
    form: Form,
    #[serde(default)]
    springs: Springs,
}

#[cfg(test)]
mod tests {
    use teeter_study::xray;

    use super::*;

    const ONE: &str = r#"{"name": "one", "friction": 0.4, "blocks": [{"id": 0, "size": [0.081, 0.0268, 0.018], "mass": 0.0196, "pos": [0, 0, 0.009]}]}"#;

    fn one() -> Simulation {
        Simulation::new(ONE, "").unwrap()
    }

    #[test]
    fn a_body_has_seven_numbers_and_its_size() {
        let simulation = one();
        assert_eq!(simulation.length(), 1);
        assert_eq!(simulation.world.poses().len(), 7);
        assert_eq!(simulation.sizes(), vec![0.081, 0.0268, 0.018]);
    }

    #[test]
    fn an_invalid_scene_or_input_is_an_error_of_one_line() {
        for (scene, params) in
            [("{", ""), ("[]", ""), (ONE, "{\"stiffness\": 1e6}"), (ONE, "nonsense"), ("{\"name\": NaN}", "")]
        {
            let line = Simulation::new(scene, params).unwrap_err().to_string();
            assert!(!line.is_empty() && !line.contains('\n'), "{line}");
        }
        let mut simulation = one();
        assert!(simulation.step("{\"hands\": 1}").unwrap_err().to_string().contains("hands"));
        let hand = r#"{"hand": {"body": 7, "anchor": [0, 0, 0], "target": [0, 0, 0], "grip": "carry"}}"#;
        assert_eq!(simulation.step(hand).unwrap_err().to_string(), "there is no body 7: the world has 1");
        assert!(simulation.contacts(1).is_err() && simulation.asleep(1).is_err());
    }

    #[test]
    fn blocks_get_springs_and_lose_them() {
        let mut simulation = one();
        assert_eq!((simulation.form().as_str(), simulation.spring_stiffness()), ("rigid", None));
        simulation.lattices_ptr();
        assert!(simulation.lattices.is_empty());
        simulation.set_form(r#"{"form": "lattice", "springs": {"stiffness": 2e6}}"#).unwrap();
        assert_eq!((simulation.form().as_str(), simulation.spring_stiffness()), ("lattice", Some(2e6)));
        simulation.lattices_ptr();
        assert_eq!(simulation.lattices.len(), 52);
        // the eighth particle is inside of the corner where all coordinates are greatest
        let inside = 0.0405 / 3f32.sqrt();
        assert!((simulation.lattices[21] - inside).abs() < 1e-6, "{:?}", &simulation.lattices[21..24]);
        let line = simulation.set_form(r#"{"form": "lattice", "springs": {"stiffness": 5}}"#).unwrap_err().to_string();
        assert_eq!(line, "`springs.stiffness` is 5, expected 1e3 to 1e8 N/m");
        assert_eq!(simulation.spring_stiffness(), Some(2e6));
    }

    /// The node tests check the same of the build for the page.
    #[test]
    fn the_xray_is_that_of_the_study() {
        let mut simulation = Simulation::new(&crate::tower_scene(r#"{"rows": 18, "seed": 1}"#).unwrap(), "").unwrap();
        for _ in 0..120 {
            simulation.step("").unwrap();
        }
        let (numbers, loads) = (simulation.xray(), xray(&simulation.world, 0.4));
        assert_eq!(numbers.len(), 2 * loads.len());
        for (numbers, load) in numbers.chunks_exact(2).zip(&loads) {
            assert_eq!(numbers, [load.above_n, load.tightness_n]);
        }
        assert_eq!(loads.iter().filter(|load| load.is_loose()).count(), 27);
        assert_eq!(loads.iter().filter(|load| load.tightness_n < 0.1).count(), 27, "loose on the page");
    }

    #[test]
    fn a_body_without_support_has_no_tightness() {
        let mut simulation = Simulation::new(&ONE.replace("0.009]", "0.5]"), "").unwrap();
        simulation.step("").unwrap();
        let numbers = simulation.xray();
        assert!(numbers[0] == 0.0 && numbers[1].is_nan(), "{numbers:?}");
    }

    #[test]
    fn a_restored_state_goes_on_with_the_same_bits() {
        let mut simulation = one();
        for _ in 0..10 {
            simulation.step("").unwrap();
        }
        let bytes = simulation.snapshot();
        let mut hashes = Vec::new();
        for _ in 0..2 {
            simulation.restore(&bytes).unwrap();
            for _ in 0..10 {
                simulation.step("").unwrap();
            }
            hashes.push(simulation.hash());
        }
        assert_eq!(hashes[0], hashes[1]);
        assert_eq!(hashes[0].len(), 16);
    }
}
