//! What is measured.

use std::path::Path;

use glam::DVec3;
use teeter_golden::runs;
use teeter_physics::{BodyId, Drive, Input, Params, Precision, Width, World};
use teeter_scene::{Form, Scene, TowerOptions, tower};

use crate::Fault;

/// A scene, the constants of a run, what acts in each frame, and which frames are measured.
#[derive(Debug, Clone)]
pub struct Workload {
    /// What it is called.
    pub name: String,
    /// Where it begins.
    pub scene: Scene,
    /// Constants.
    pub params: Params,
    /// What acts in each frame from the first one on; nothing after its end.
    pub inputs: Vec<Input>,
    /// Frames before those that are measured.
    pub settle: usize,
    /// Frames that are measured.
    pub frames: usize,
}

/// Frames until a tower of 18 rows stands still.
const SETTLE: usize = 120;
/// Frames until one of 60 rows does.
const SETTLE_TALL: usize = 2400;
/// Frames after which one of 60 rows still sways.
const SWAY: usize = 600;
/// Frames of a sweep before the drives begin, and during which they push.
const SWEEP: (usize, usize) = (60, 12);

impl Workload {
    /// A full tower of `rows` rows and this stiffness, N/m, that stands and is kept awake.
    ///
    /// # Errors
    /// When there is no tower of so many rows.
    pub fn awake(rows: u32, stiffness: f64, precision: Precision) -> Result<Self, Fault> {
        let scene = tower(&TowerOptions { rows, ..TowerOptions::default() }).map_err(|e| e.to_string())?;
        let scene = Scene { stiffness, ..scene };
        let format = if precision == Precision::Single { "f32" } else { "f64" };
        let name = match rows {
            18 => format!("awake, k = {stiffness:e}, {format}"),
            _ => format!("awake, {rows} rows"),
        };
        let params = Params { precision, sleep: false, ..Params::default() };
        let settle = if rows == 18 { SETTLE } else { SETTLE_TALL };
        Ok(Self { name, scene, params, inputs: Vec::new(), settle, frames: 60 })
    }

    /// The full tower of blocks of springs, as stiff as their contacts, that stands and is kept awake.
    ///
    /// # Errors
    /// Never, for there is a tower of so many rows.
    pub fn springs() -> Result<Self, Fault> {
        let rigid = Self::awake(18, 1e6, Precision::Single)?;
        Ok(Self { name: "springs, awake".into(), scene: Scene { form: Form::Lattice, ..rigid.scene }, ..rigid })
    }

    /// A tower of 60 rows that sways by some millimetres a second, with the detection that this asks for.
    ///
    /// # Errors
    /// Never, for there is a tower of so many rows.
    pub fn swaying() -> Result<Self, Fault> {
        Ok(Self { name: "swaying, 60 rows".into(), settle: SWAY, ..Self::awake(60, 1e6, Precision::Single)? })
    }

    /// The tower that a game begins with, asleep.
    ///
    /// # Errors
    /// Never, for the scene is on the list.
    pub fn asleep() -> Result<Self, Fault> {
        let scene = teeter_scene::named("tower").ok_or("there is no tower in the list of scenes")?;
        Ok(Self {
            name: "asleep".into(),
            scene,
            params: Params::default(),
            inputs: Vec::new(),
            settle: SETTLE,
            frames: 600,
        })
    }

    /// A golden run from frame `settle` on, to its end.
    ///
    /// # Errors
    /// When there is no such run or its files cannot be read.
    pub fn golden(name: &str, settle: usize) -> Result<Self, Fault> {
        let dir = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../../data/golden"));
        let run = runs(dir)?
            .into_iter()
            .find(|run| run.name == name)
            .ok_or_else(|| format!("there is no golden run called {name}"))?;
        let frames = run.inputs.len() - settle;
        Ok(Self { name: name.into(), scene: run.scene, params: run.params, inputs: run.inputs, settle, frames })
    }

    /// The same in other registers.
    #[must_use]
    pub fn in_width(mut self, width: Width) -> Self {
        self.name = format!("{}, {}", self.name, format!("{width:?}").to_lowercase());
        self.params.width = width;
        self
    }

    /// The same with so many measured frames.
    #[must_use]
    pub fn of_frames(self, frames: usize) -> Self {
        Self { frames, ..self }
    }

    /// The world of its first frame.
    ///
    /// # Errors
    /// When the scene or a constant is not valid.
    pub fn world(&self) -> Result<World, Fault> {
        World::new(&self.scene, self.params).map_err(|e| format!("{}: {e}", self.name))
    }

    /// The world of its first measured frame.
    ///
    /// # Errors
    /// As [`Workload::world`].
    pub fn settled(&self) -> Result<World, Fault> {
        let mut world = self.world()?;
        let idle = Input::default();
        (0..self.settle).for_each(|frame| drop(world.step(self.inputs.get(frame).unwrap_or(&idle))));
        Ok(world)
    }

    /// What acts in the measured frames.
    pub fn measured(&self) -> Vec<Input> {
        let mut inputs = self.inputs.get(self.settle..).unwrap_or_default().to_vec();
        inputs.resize(self.frames, Input::default());
        inputs
    }
}

/// A tower of `rows` rows of which the blocks of some rows are driven out at `speed`, m/s, until all has come down.
///
/// # Errors
/// When there is no tower of so many rows.
pub fn swept(name: &str, rows: u32, driven: std::ops::Range<u32>, speed: f64) -> Result<Workload, Fault> {
    let scene = tower(&TowerOptions { rows, ..TowerOptions::default() }).map_err(|e| e.to_string())?;
    let drive = |body| Drive::new(BodyId(body), DVec3::new(speed, 0.25 * speed, 0.0));
    let mut inputs = vec![Input::default(); SWEEP.0];
    let drives = (3 * driven.start..3 * driven.end).map(drive).collect();
    inputs.resize(SWEEP.0 + SWEEP.1, Input::drives(drives));
    Ok(Workload { name: name.into(), scene, params: Params::default(), inputs, settle: SWEEP.0, frames: 180 })
}

/// The workloads whose instructions are counted. Each names its registers, for the widest that a processor has would be another
/// count on each, and valgrind knows none beyond AVX2; and each is short, for it takes fifty times as long.
///
/// # Errors
/// When a golden run cannot be read.
pub fn counted() -> Result<Vec<Workload>, Fault> {
    use Precision::{Double, Single};
    use Width::{Avx2, Portable, Sse2};
    Ok(vec![
        Workload::awake(18, 1e6, Single)?.of_frames(10).in_width(Portable),
        Workload::awake(18, 1e6, Single)?.of_frames(10).in_width(Sse2),
        Workload::awake(18, 1e6, Single)?.of_frames(10).in_width(Avx2),
        Workload::awake(18, 3e5, Single)?.of_frames(10).in_width(Avx2),
        Workload::awake(18, 3e6, Single)?.of_frames(10).in_width(Avx2),
        Workload::awake(18, 1e6, Double)?.of_frames(10).in_width(Avx2),
        Workload::springs()?.of_frames(10).in_width(Avx2),
        Workload::awake(6, 1e6, Single)?.of_frames(10).in_width(Avx2),
        Workload::swaying()?.of_frames(5).in_width(Avx2),
        Workload::asleep()?.of_frames(60).in_width(Avx2),
        Workload::golden("pull", 130)?.of_frames(30).in_width(Avx2),
        Workload::golden("collapse", 60)?.of_frames(60).in_width(Avx2),
    ])
}
