//! A world behind the border.

use teeter_physics::{Input, Params, World};
use teeter_scene::Scene;
use wasm_bindgen::prelude::*;

use crate::Failure;

/// A world that a worker owns and steps.
#[wasm_bindgen]
#[derive(Debug)]
pub struct Simulation {
    world: World,
}

#[wasm_bindgen]
impl Simulation {
    /// Builds a world from a scene (JSON) and the constants of the run (JSON of [`Params`]; empty text for the usual ones).
    #[wasm_bindgen(constructor)]
    pub fn new(scene: &str, params: &str) -> Result<Simulation, Failure> {
        let scene = Scene::from_json(scene).map_err(|e| Failure(e.to_string()))?;
        let params: Params = if params.trim().is_empty() {
            Params::default()
        } else {
            serde_json::from_str(params).map_err(|e| Failure::reading("parameters", e))?
        };
        let world = World::new(&scene, params).map_err(|e| Failure(e.to_string()))?;
        Ok(Self { world })
    }

    /// Advances by one frame under `input` (JSON of [`Input`]; empty text for none) and gives the report as JSON.
    ///
    /// A hand, force or drive on a body that does not exist is an error, and the world stays as it was.
    pub fn step(&mut self, input: &str) -> Result<String, Failure> {
        let input: Input = if input.trim().is_empty() {
            Input::default()
        } else {
            serde_json::from_str(input).map_err(|e| Failure::reading("input", e))?
        };
        let bodies =
            input.hand.iter().map(|h| h.body).chain(input.forces.iter().map(|f| f.body)).chain(input.drives.iter().map(|d| d.body));
        for body in bodies {
            self.check(body)?;
        }
        let report = self.world.step(&input);
        serde_json::to_string(&report).map_err(|e| Failure::reading("report", e))
    }

    /// Where the poses lie in wasm memory: seven doubles a body, position (m) and orientation (x, y, z, w). Any later call may move them, so make the view anew.
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
        (0..self.world.len() as u32).flat_map(|body| self.world.size(body).to_array()).collect()
    }

    /// The loaded contacts of a body as JSON: `[{"other", "point", "normal", "force"}]`.
    pub fn contacts(&self, body: u32) -> Result<String, Failure> {
        self.check(body)?;
        serde_json::to_string(&self.world.contacts(body)).map_err(|e| Failure::reading("contacts", e))
    }

    /// Whether a body sleeps.
    pub fn asleep(&self, body: u32) -> Result<bool, Failure> {
        self.check(body)?;
        Ok(self.world.asleep(body))
    }

    /// Hash of the whole state, 16 hexadecimal digits.
    pub fn hash(&self) -> String {
        format!("{:016x}", self.world.hash())
    }

    /// The whole state as bytes.
    pub fn snapshot(&self) -> Vec<u8> {
        self.world.snapshot()
    }

    /// Takes back a state of the same scene and constants. Bytes that are none leave the world as it was.
    pub fn restore(&mut self, bytes: &[u8]) -> Result<(), Failure> {
        self.world.restore(bytes).map_err(|e| Failure(e.to_string()))
    }

    /// Stiffness of the scene, N/m.
    #[wasm_bindgen(getter)]
    pub fn stiffness(&self) -> f64 {
        self.world.stiffness()
    }

    /// Simulated time, s.
    pub fn time(&self) -> f64 {
        self.world.time()
    }

    fn check(&self, body: u32) -> Result<(), Failure> {
        let count = self.world.len();
        if (body as usize) < count { Ok(()) } else { Err(Failure(format!("there is no body {body}: the world has {count}"))) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const ONE: &str =
        r#"{"name": "one", "friction": 0.4, "blocks": [{"id": 0, "size": [0.081, 0.0268, 0.018], "mass": 0.0196, "pos": [0, 0, 0.009]}]}"#;

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
    fn what_is_no_scene_or_no_input_is_told_in_one_line() {
        for (scene, params) in [("{", ""), ("[]", ""), (ONE, "{\"stiffness\": 1e6}"), (ONE, "nonsense"), ("{\"name\": NaN}", "")] {
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
