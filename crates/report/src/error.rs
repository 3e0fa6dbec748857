//! Errors of the reports.

use std::io;
use std::path::PathBuf;

use teeter_dissertation::jenga3d;
use teeter_physics::BuildError;
use teeter_scene::SceneError;
use teeter_study::LimitError;

use crate::score::LabelledError;

/// Error of measuring or of writing a report.
///
/// ```
/// # use teeter_report::Error;
/// # use teeter_scene::named;
/// # use teeter_study::RigidTower;
/// fn top(name: &str) -> Result<f64, Error> {
///     let scene = named(name).ok_or_else(|| Error::UnknownScene(name.into()))?;
///     Ok(RigidTower::new(&scene)?.top()?)
/// }
///
/// assert_eq!(top("castle").unwrap_err().to_string(), "there is no scene `castle`");
/// assert!(matches!(top("test-4"), Err(Error::Exact(_))));
/// assert!(top("block").is_ok());
/// ```
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// A built-in scene that the engine refuses.
    #[error("a scene of the report cannot be built: {0}")]
    Build(#[from] BuildError),
    /// A built-in scene that the simulator of the dissertation refuses.
    #[error("a scene of the report cannot be built: {0}")]
    Springs(#[from] jenga3d::BuildError),
    /// A built-in scene that is not valid.
    #[error("a scene of the report is not valid: {0}")]
    Scene(#[from] SceneError),
    /// A built-in scene without an exact answer.
    #[error("a scene of the report has no exact answer: {0}")]
    Exact(#[from] LimitError),
    /// Labelled towers that cannot be read.
    #[error(transparent)]
    Labelled(#[from] LabelledError),
    /// Frame rate of the 2003 method that is not that of the report, 1/s.
    #[error("`frame_rate` is {0}, expected 60: the report compares frames of 1/60 s")]
    FrameRate(f64),
    /// Name of no built-in scene.
    #[error("there is no scene `{0}`")]
    UnknownScene(String),
    /// A real tower that the engine refuses.
    #[error("the tower of the data sheet cannot be built: {0}")]
    RealTower(BuildError),
    /// A data sheet without a single measured force.
    #[error("the data sheet has no pulls to compare")]
    NoPulls,
    /// An output folder that cannot be created.
    #[error("{}: this folder cannot be made: {source}", path.display())]
    CreateFolder {
        /// Path of the folder.
        path: PathBuf,
        /// Cause.
        source: io::Error,
    },
    /// An output file that cannot be written.
    #[error("{}: cannot be written: {source}", path.display())]
    WriteFile {
        /// Path of the file.
        path: PathBuf,
        /// Cause.
        source: io::Error,
    },
    /// A thread pool that cannot be started.
    #[error("threads cannot be started: {0}")]
    Threads(#[from] rayon::ThreadPoolBuildError),
}
