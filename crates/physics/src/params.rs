//! Constants of a run.

use serde::{Deserialize, Serialize};

/// Number format of the inner loop. Poses, and gaps at each sync, are double precision in both.
///
/// ```
/// use teeter_physics::{BodyId, Params, Precision, World};
///
/// let scene = teeter_scene::named("column").unwrap();
/// let height = |precision| -> Result<f64, teeter_physics::BuildError> {
///     let mut world = World::new(&scene, Params { precision, ..Params::default() })?;
///     world.run_for(1.0);
///     Ok(world.pose(BodyId(3)).position.z)
/// };
/// let difference = height(Precision::Single)? - height(Precision::Double)?;
/// assert!(difference.abs() < 1e-7);
/// # Ok::<(), teeter_physics::BuildError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Precision {
    /// f32: fast, for play.
    Single,
    /// f64: the reference that tests compare single precision with.
    Double,
}

/// Register width of the inner loop. All give the same bits: the choice is for measurements and
/// tests.
///
/// A processor without a width uses the widest below it. Where the target leaves no choice, as in
/// WebAssembly, every width means the one that the program was built for.
///
/// ```
/// use teeter_physics::{Params, Width, World};
///
/// let scene = teeter_scene::named("column").unwrap();
/// let hash = |width| -> Result<u64, teeter_physics::BuildError> {
///     let mut world = World::new(&scene, Params { width, ..Params::default() })?;
///     world.run_for(0.5);
///     Ok(world.hash())
/// };
/// assert_eq!(hash(Width::Auto)?, hash(Width::Portable)?);
/// # Ok::<(), teeter_physics::BuildError>(())
/// ```
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Width {
    /// Widest registers of the processor.
    #[default]
    Auto,
    /// Scalars, vectorised by the compiler where it can.
    Portable,
    /// 128 bits: every x86-64.
    Sse2,
    /// 256 bits.
    Avx2,
    /// 512 bits in single precision, 256 in double.
    Avx512,
}

impl Width {
    /// Returns true if this processor has the width; otherwise a narrower one is used.
    pub fn available(self) -> bool {
        #[cfg(target_arch = "x86_64")]
        return match self {
            Width::Auto | Width::Portable | Width::Sse2 => true,
            Width::Avx2 => std::is_x86_feature_detected!("avx2"),
            Width::Avx512 => crate::simd::avx512::available(),
        };
        #[cfg(not(target_arch = "x86_64"))]
        return matches!(self, Width::Auto | Width::Portable);
    }
}

/// Constants of a run: with the scene, the state and the inputs they determine all of the future.
///
/// ```
/// use teeter_physics::{Params, Precision, World};
///
/// let scene = teeter_scene::named("block").unwrap();
/// let reference = Params { precision: Precision::Double, sleep: false, ..Params::default() };
/// assert!(World::new(&scene, reference).is_ok());
/// let error = World::new(&scene, Params { frame: 1.0, ..reference }).unwrap_err();
/// assert_eq!(error.to_string(), "parameter `frame` is 1, expected 0.0001 to 0.1 s");
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Params {
    /// Number format of the inner loop.
    pub precision: Precision,
    /// Register width of the inner loop; never changes the result.
    pub width: Width,
    /// Bodies at rest may sleep. Sleep saves work and never decides stability.
    pub sleep: bool,
    /// Time over which gravity ramps to its full value at the start, s. Where it is zero, what
    /// touches carries its weight from the first instant, and what is in the air falls.
    pub ramp: f64,
    /// Length of a frame, the time that one step covers, s.
    pub frame: f64,
}

impl Default for Params {
    fn default() -> Self {
        Self { precision: Precision::Single, width: Width::Auto, sleep: true, ramp: 0.0, frame: 1.0 / 60.0 }
    }
}
