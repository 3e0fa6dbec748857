//! The runs, and playing them.

use std::path::Path;

use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use teeter_physics::{Input, Params, Width, World};
use teeter_scene::{Form, Scene, Springs};

use crate::{Fault, read};

/// One run as it stands in `runs.json`.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Entry {
    name: String,
    /// A scene of the list.
    scene: String,
    /// Stiffness in place of the scene's own, N/m.
    #[serde(default)]
    stiffness: Option<f64>,
    /// What the blocks are, and the springs within them.
    #[serde(default)]
    form: Form,
    #[serde(default)]
    springs: Springs,
    #[serde(default)]
    params: Params,
    steps: u32,
    /// A file with the input of one step a line; none acts after its end.
    #[serde(default)]
    inputs: Option<String>,
}

/// A scene, the constants of a run, and the input of each step.
#[derive(Debug, Clone)]
pub struct Run {
    /// What it is called.
    pub name: String,
    /// Where it begins.
    pub scene: Scene,
    /// Constants.
    pub params: Params,
    /// Inputs of the steps.
    pub inputs: Vec<Input>,
}

/// What came of a run.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Outcome {
    /// The step since which all bodies have slept; none where one is awake at the end.
    pub step_of_rest: Option<u32>,
    /// Hash of the state after the last step, 16 hexadecimal digits. A bit that differs at any time is still in the poses at the end.
    pub hash: String,
}

/// The runs of a folder.
///
/// # Errors
/// When a file cannot be read, naming it.
pub fn runs(dir: &Path) -> Result<Vec<Run>, Fault> {
    let entries: Vec<Entry> = serde_json::from_str(&read(dir, "runs.json")?).map_err(|e| format!("runs.json: {e}"))?;
    entries.into_iter().map(|entry| entry.load(dir)).collect()
}

impl Entry {
    fn load(self, dir: &Path) -> Result<Run, Fault> {
        let Entry { name, scene, stiffness, form, springs, params, steps, inputs } = self;
        let mut scene =
            teeter_scene::named(&scene).ok_or_else(|| format!("run {name}: there is no scene called `{scene}`"))?;
        scene.stiffness = stiffness.unwrap_or(scene.stiffness);
        (scene.form, scene.springs) = (form, springs);
        let text = inputs.as_ref().map_or(Ok(String::new()), |file| read(dir, file))?;
        let mut inputs: Vec<Input> = Vec::new();
        for (i, line) in text.lines().enumerate() {
            let input = if line.is_empty() { Ok(Input::default()) } else { serde_json::from_str(line) };
            inputs.push(input.map_err(|e| format!("run {name}: line {} of its inputs: {e}", i + 1))?);
        }
        inputs.resize(steps as usize, Input::default());
        Ok(Run { name, scene, params, inputs })
    }
}

impl Run {
    /// The world that it begins with.
    ///
    /// # Errors
    /// When a constant is out of range.
    pub fn world(&self, width: Width) -> Result<World, Fault> {
        World::new(&self.scene, Params { width, ..self.params }).map_err(|e| format!("run {}: {e}", self.name))
    }

    /// Steps to the end.
    ///
    /// # Errors
    /// As [`Run::world`].
    pub fn play(&self, width: Width) -> Result<Outcome, Fault> {
        let mut world = self.world(width)?;
        let mut step_of_rest = None;
        for (i, input) in self.inputs.iter().enumerate() {
            step_of_rest = if world.step(input).awake > 0 { None } else { step_of_rest.or(Some(i as u32 + 1)) };
        }
        Ok(Outcome { step_of_rest, hash: format!("{:016x}", world.hash()) })
    }
}

/// Plays all runs, side by side in so many threads, which also share the towers of a field; the outcomes in the order of the runs.
///
/// # Errors
/// As [`Run::world`].
pub fn play_all(runs: &[Run], width: Width, threads: usize) -> Result<Vec<Outcome>, Fault> {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().map_err(|e| e.to_string())?;
    pool.install(|| runs.par_iter().map(|run| run.play(width)).collect())
}
