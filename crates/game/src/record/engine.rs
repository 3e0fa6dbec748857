//! Identity of the engine that a record was made by.

/// Hash of the golden results: it changes with any bit that the engine computes. A test of the
/// golden runs holds it.
const GOLDEN_BITS: &str = "f5c343a57cc363fc";

/// Identity of this engine: the version of the program, and a hash of its golden results.
///
/// A record replays with the engine of its identity. Another one may step with other bits, and the
/// record then plays from its keyframes.
///
/// ```
/// let id = teeter_game::engine_id();
/// let (version, bits) = id.split_once('+').expect("two parts");
/// assert!(version.starts_with("0.") && bits.len() == 16);
/// ```
pub fn engine_id() -> String {
    format!("{}+{GOLDEN_BITS}", env!("CARGO_PKG_VERSION"))
}
