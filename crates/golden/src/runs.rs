//! Golden runs and their playback.

use std::path::Path;

use rayon::prelude::*;
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use teeter_game::{Command, Game};
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
    /// Name of a file with one line of a game's command a step; the run then has no inputs.
    #[serde(default)]
    commands: Option<String>,
}

/// Golden run: a scene, constants, and the input of each step, or the command of a game.
///
/// ```
/// use teeter_golden::Run;
/// use teeter_physics::{Input, Params, Width};
///
/// let scene = teeter_scene::named("block").expect("the list has it");
/// let inputs = vec![Input::default(); 10];
/// let (params, commands) = (Params::default(), Vec::new());
/// let run = Run { name: "block".into(), scene, params, inputs, commands };
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
    /// Inputs of the steps; empty for a game.
    pub inputs: Vec<Input>,
    /// Commands of the steps of a game.
    pub commands: Vec<Command>,
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
        let Entry { name, scene, stiffness, form, springs, params, steps, inputs, commands } = self;
        let Some(mut scene) = teeter_scene::named(&scene) else {
            return Err(GoldenError::UnknownScene { run: name, scene });
        };
        scene.stiffness = stiffness.unwrap_or(scene.stiffness);
        (scene.form, scene.springs) = (form, springs);
        let (inputs, commands) = match commands {
            Some(file) => (Vec::new(), parse_lines(&name, &read(dir, &file)?, steps)?),
            None => {
                let text = inputs.map_or(Ok(String::new()), |file| read(dir, &file))?;
                (parse_lines(&name, &text, steps)?, Vec::new())
            }
        };
        Ok(Run { name, scene, params, inputs, commands })
    }
}

/// Parses one value a line, the default where a line is empty, for `steps` steps.
fn parse_lines<T: DeserializeOwned + Default>(run: &str, text: &str, steps: u32) -> Result<Vec<T>, GoldenError> {
    let parse = |(i, line): (usize, &str)| {
        let value = if line.is_empty() { Ok(T::default()) } else { serde_json::from_str(line) };
        value.map_err(|e| GoldenError::Input { run: run.to_owned(), line: i + 1, message: e.to_string() })
    };
    let mut values = text.lines().enumerate().map(parse).collect::<Result<Vec<T>, _>>()?;
    values.resize_with(steps as usize, T::default);
    Ok(values)
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
        let (awake, hash): (Vec<u32>, u64) = if self.commands.is_empty() {
            (self.inputs.iter().map(|input| world.step(input).awake).collect(), world.hash())
        } else {
            let mut game = Game::new(world);
            (self.commands.iter().map(|command| game.step(command).report.awake).collect(), game.hash())
        };
        let steps_awake = awake.iter().rposition(|count| *count > 0).map_or(0, |i| i + 1);
        let step_of_rest = (steps_awake < awake.len()).then_some(steps_awake as u32 + 1);
        Ok(Outcome { step_of_rest, hash: format!("{hash:016x}") })
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
