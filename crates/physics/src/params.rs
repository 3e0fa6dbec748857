//! Constants of a run.

use serde::{Deserialize, Serialize};

/// Number format of the inner loop. Poses and gaps at sync are double in both.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Precision {
    /// f32: fast, what is played.
    Single,
    /// f64: the truth that the fast loop is tested against.
    Double,
}

/// Registers that the inner loop works in. All give the same bits: this is for measuring and for tests.
///
/// A processor that lacks a width uses the widest below it that it has. Where the target leaves no choice, as in WebAssembly, every
/// width means the one that the program was built for.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Width {
    /// The widest that the processor has.
    #[default]
    Auto,
    /// Plain numbers, for the compiler to make the best of.
    Portable,
    /// 128 bits, which every x86-64 has.
    Sse2,
    /// 256 bits.
    Avx2,
    /// 512 bits in single precision, 256 in double.
    Avx512,
}

impl Width {
    /// Whether this processor has it; where it has not, another is used in its place.
    pub fn available(self) -> bool {
        #[cfg(target_arch = "x86_64")]
        return match self {
            Width::Auto | Width::Portable | Width::Sse2 => true,
            Width::Avx2 => std::is_x86_feature_detected!("avx2"),
            Width::Avx512 => crate::lanes::avx512::available(),
        };
        #[cfg(not(target_arch = "x86_64"))]
        return matches!(self, Width::Auto | Width::Portable);
    }
}

/// Constants of a run: with the scene, the state and the inputs they determine all of the future.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Params {
    /// Number format of the inner loop.
    pub precision: Precision,
    /// Registers of the inner loop; never changes the result.
    pub width: Width,
    /// Whether bodies at rest may sleep. It saves work and never decides stability.
    pub sleep: bool,
    /// Time over which gravity grows to its full value at the start, s. Gravity at once would drop a tower onto its springs.
    pub ramp: f64,
    /// Time that one step covers, s.
    pub frame: f64,
}

impl Default for Params {
    fn default() -> Self {
        Self { precision: Precision::Single, width: Width::Auto, sleep: true, ramp: 0.3, frame: 1.0 / 60.0 }
    }
}
