//! Workloads: the frames that are measured.

use std::path::Path;

use glam::DVec3;
use teeter_golden::runs;
use teeter_physics::{BodyId, Drive, Input, Params, Precision, Width, World};
use teeter_scene::{Form, Scene, TowerOptions, tower};

use crate::error::CostError;

/// Workload: a scene, constants, the input of each frame, and the frames that are measured.
///
/// ```
/// use teeter_cost::Workload;
/// use teeter_physics::Precision;
///
/// let workload = Workload::awake(6, 1e6, Precision::Single).expect("a valid tower").of_frames(10);
/// assert_eq!((workload.name.as_str(), workload.measured().len()), ("awake, 6 rows", 10));
/// ```
#[derive(Debug, Clone)]
pub struct Workload {
    /// Name of the workload.
    pub name: String,
    /// Scene at the start.
    pub scene: Scene,
    /// Constants of the run.
    pub params: Params,
    /// Inputs of the frames from the first one; later frames have none.
    pub inputs: Vec<Input>,
    /// Number of frames before the measured ones.
    pub settle: usize,
    /// Number of measured frames.
    pub frames: usize,
}

/// Frames until a tower of 18 rows rests.
const SETTLE: usize = 120;
/// Frames until a tower of 60 rows rests.
const SETTLE_TALL: usize = 2400;
/// Frames after which a tower of 60 rows still sways.
const SWAY: usize = 600;
/// Frames of a sweep before the drives start, and frames of the drives.
const SWEEP: (usize, usize) = (60, 12);

impl Workload {
    /// Creates a full tower of `rows` rows and this stiffness (N/m) at rest with sleep disabled.
    ///
    /// # Errors
    /// When the number of rows is out of range.
    pub fn awake(rows: u32, stiffness: f64, precision: Precision) -> Result<Self, CostError> {
        let scene = tower(&TowerOptions { rows, ..TowerOptions::default() })?;
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

    /// Creates the full tower of lattice blocks, as stiff as their contacts, at rest with sleep
    /// disabled.
    ///
    /// # Errors
    /// Never: its tower is valid.
    pub fn springs() -> Result<Self, CostError> {
        let rigid = Self::awake(18, 1e6, Precision::Single)?;
        Ok(Self { name: "springs, awake".into(), scene: Scene { form: Form::Lattice, ..rigid.scene }, ..rigid })
    }

    /// Creates a tower of 60 rows that sways by some millimetres a second, which needs collision
    /// detection.
    ///
    /// # Errors
    /// Never: its tower is valid.
    pub fn swaying() -> Result<Self, CostError> {
        Ok(Self { name: "swaying, 60 rows".into(), settle: SWAY, ..Self::awake(60, 1e6, Precision::Single)? })
    }

    /// Creates the default tower, asleep.
    ///
    /// # Errors
    /// Never: the list has the scene.
    pub fn asleep() -> Result<Self, CostError> {
        let scene = teeter_scene::named("tower").ok_or(CostError::UnknownScene("tower"))?;
        Ok(Self {
            name: "asleep".into(),
            scene,
            params: Params::default(),
            inputs: Vec::new(),
            settle: SETTLE,
            frames: 600,
        })
    }

    /// Creates the part of a golden run from frame `settle` to its end.
    ///
    /// # Errors
    /// When the run does not exist or its files cannot be read.
    pub fn golden(name: &str, settle: usize) -> Result<Self, CostError> {
        let dir = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../../data/golden"));
        let run = runs(dir)?
            .into_iter()
            .find(|run| run.name == name)
            .ok_or_else(|| CostError::UnknownRun(name.to_owned()))?;
        let frames = run.inputs.len() - settle;
        Ok(Self { name: name.into(), scene: run.scene, params: run.params, inputs: run.inputs, settle, frames })
    }

    /// Sets the register width.
    #[must_use]
    pub fn in_width(mut self, width: Width) -> Self {
        self.name = format!("{}, {}", self.name, format!("{width:?}").to_lowercase());
        self.params.width = width;
        self
    }

    /// Sets the number of measured frames.
    #[must_use]
    pub fn of_frames(self, frames: usize) -> Self {
        Self { frames, ..self }
    }

    /// Builds the world at the first frame.
    ///
    /// # Errors
    /// When the scene or a constant is not valid.
    pub fn world(&self) -> Result<World, CostError> {
        World::new(&self.scene, self.params).map_err(|error| CostError::World { workload: self.name.clone(), error })
    }

    /// Builds the world at the first measured frame.
    ///
    /// # Errors
    /// As [`Workload::world`].
    pub fn settled(&self) -> Result<World, CostError> {
        let mut world = self.world()?;
        let idle = Input::default();
        (0..self.settle).for_each(|frame| drop(world.step(self.inputs.get(frame).unwrap_or(&idle))));
        Ok(world)
    }

    /// Inputs of the measured frames.
    pub fn measured(&self) -> Vec<Input> {
        let mut inputs = self.inputs.get(self.settle..).unwrap_or_default().to_vec();
        inputs.resize(self.frames, Input::default());
        inputs
    }
}

/// Creates a tower of `rows` rows that collapses because the blocks of some rows are driven out at
/// `speed`, m/s.
///
/// # Errors
/// When the number of rows is out of range.
pub fn swept(name: &str, rows: u32, driven: std::ops::Range<u32>, speed: f64) -> Result<Workload, CostError> {
    let scene = tower(&TowerOptions { rows, ..TowerOptions::default() })?;
    let drive = |body| Drive::new(BodyId(body), DVec3::new(speed, 0.25 * speed, 0.0));
    let mut inputs = vec![Input::default(); SWEEP.0];
    let drives = (3 * driven.start..3 * driven.end).map(drive).collect();
    inputs.resize(SWEEP.0 + SWEEP.1, Input::drives(drives));
    Ok(Workload { name: name.into(), scene, params: Params::default(), inputs, settle: SWEEP.0, frames: 180 })
}

/// Returns the workloads whose instructions are counted.
///
/// Each has a fixed register width, because the widest one differs between processors and valgrind
/// knows none beyond AVX2. Each is short, because it runs fifty times slower.
///
/// # Errors
/// When a golden run cannot be read.
pub fn counted() -> Result<Vec<Workload>, CostError> {
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
