//! Golden runs and their playback.

use std::path::Path;

use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use teeter_physics::{Input, Params, Width, World};
use teeter_scene::{Form, Scene, Springs};

use crate::error::GoldenError;
use crate::files::read;

/// Entry of `runs.json`.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Entry {
    name: String,
    /// Name of a scene of the list.
    scene: String,
    /// Stiffness that overrides that of the scene, N/m.
    #[serde(default)]
    stiffness: Option<f64>,
    /// Form of the blocks.
    #[serde(default)]
    form: Form,
    #[serde(default)]
    springs: Springs,
    #[serde(default)]
    params: Params,
    steps: u32,
    /// Name of a file with one line of input a step; the steps after its end have none.
    #[serde(default)]
    inputs: Option<String>,
}

/// Golden run: a scene, constants, and the input of each step.
///
/// ```
/// use teeter_golden::Run;
/// use teeter_physics::{Input, Params, Width};
///
/// let scene = teeter_scene::named("block").expect("the list has it");
/// let run = Run { name: "block".into(), scene, params: Params::default(), inputs: vec![Input::default(); 10] };
/// let outcome = run.play(Width::Portable).expect("a valid scene");
/// assert_eq!(outcome, run.play(Width::Auto).expect("a valid scene"));
/// ```
#[derive(Debug, Clone)]
pub struct Run {
    /// Name of the run.
    pub name: String,
    /// Scene at the start.
    pub scene: Scene,
    /// Constants of the run.
    pub params: Params,
    /// Inputs of the steps.
    pub inputs: Vec<Input>,
}

/// Outcome of a run.
///
/// ```
/// use teeter_golden::Outcome;
///
/// let outcome = Outcome { step_of_rest: Some(75), hash: format!("{:016x}", 7) };
/// assert_eq!(outcome.hash.len(), 16);
/// ```
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Outcome {
    /// Step from which all bodies sleep; `None` if one is awake at the end.
    pub step_of_rest: Option<u32>,
    /// Hash of the state after the last step, 16 hexadecimal digits. A bit that differs at any time
    /// still shows in the poses at the end.
    pub hash: String,
}

/// Reads the runs of a folder.
///
/// # Errors
/// Names the file that cannot be read or parsed.
pub fn runs(dir: &Path) -> Result<Vec<Run>, GoldenError> {
    let entries: Vec<Entry> =
        serde_json::from_str(&read(dir, "runs.json")?).map_err(|e| GoldenError::file("runs.json", e))?;
    entries.into_iter().map(|entry| entry.load(dir)).collect()
}

impl Entry {
    fn load(self, dir: &Path) -> Result<Run, GoldenError> {
        let Entry { name, scene, stiffness, form, springs, params, steps, inputs } = self;
        let Some(mut scene) = teeter_scene::named(&scene) else {
            return Err(GoldenError::UnknownScene { run: name, scene });
        };
        scene.stiffness = stiffness.unwrap_or(scene.stiffness);
        (scene.form, scene.springs) = (form, springs);
        let text = inputs.as_ref().map_or(Ok(String::new()), |file| read(dir, file))?;
        let mut inputs: Vec<Input> = Vec::new();
        for (i, line) in text.lines().enumerate() {
            let input = if line.is_empty() { Ok(Input::default()) } else { serde_json::from_str(line) };
            let error =
                |e: serde_json::Error| GoldenError::Input { run: name.clone(), line: i + 1, message: e.to_string() };
            inputs.push(input.map_err(error)?);
        }
        inputs.resize(steps as usize, Input::default());
        Ok(Run { name, scene, params, inputs })
    }
}

impl Run {
    /// Builds the world at the start.
    ///
    /// # Errors
    /// When a constant is out of range.
    pub fn world(&self, width: Width) -> Result<World, GoldenError> {
        World::new(&self.scene, Params { width, ..self.params })
            .map_err(|error| GoldenError::World { run: self.name.clone(), error })
    }

    /// Plays the run to its end.
    ///
    /// # Errors
    /// As [`Run::world`].
    pub fn play(&self, width: Width) -> Result<Outcome, GoldenError> {
        let mut world = self.world(width)?;
        let mut step_of_rest = None;
        for (i, input) in self.inputs.iter().enumerate() {
            step_of_rest = if world.step(input).awake > 0 { None } else { step_of_rest.or(Some(i as u32 + 1)) };
        }
        Ok(Outcome { step_of_rest, hash: format!("{:016x}", world.hash()) })
    }
}

/// Plays all runs in parallel on `threads` threads, which also share the clusters of a world, and
/// returns the outcomes in the order of the runs.
///
/// # Errors
/// As [`Run::world`], or when the thread pool cannot be created.
pub fn play_all(runs: &[Run], width: Width, threads: usize) -> Result<Vec<Outcome>, GoldenError> {
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(threads)
        .build()
        .map_err(|e| GoldenError::Threads(e.to_string()))?;
    pool.install(|| runs.par_iter().map(|run| run.play(width)).collect())
}
