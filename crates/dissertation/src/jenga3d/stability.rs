//! Limits of constants that depend on each other: steps that the springs would not survive, and
//! rules that no tower could play by.
//!
//! The springs of a block connect every pair of its eight particles, so their matrix has no
//! eigenvalue above 8 k: a mode of a block has ω² <= 8 k / m, and its damping is in the same ratio,
//! γ <= 8 c / m. With fewer springs both are lower.

use super::constant::{Constant, ConstantError, Range, Value};
use super::constants::Constants;
use super::options::{Disabling, Method};

/// Maximum eigenvalue of the springs of a block, over their stiffness.
const MAX_EIGENVALUE: f64 = 8.0;

/// Bisections in the search for a limit.
const BISECTIONS: u32 = 60;

/// Checks constants against each other for particles of at least `mass` (kg).
///
/// # Errors
/// Names a constant, its value, and the values with which the others agree.
pub fn check(constants: &Constants, mass: f64) -> Result<(), ConstantError> {
    if !is_stable(constants, mass) {
        return Err(divergence(constants, mass));
    }
    let step = constants.step();
    if constants.hand_rate * step > 1.0 {
        let limit = round_down(1.0 / step);
        return error(constants, "hand_rate", format!("at most {limit} 1/s, or the hand passes its target in a step"));
    }
    let fall = 0.5 * constants.gravity * constants.rest_time * constants.rest_time;
    if constants.disabling == Disabling::Rigid && constants.gravity > 0.0 && fall <= constants.rest_distance {
        let limit = round_down(fall);
        return error(
            constants,
            "rest_distance",
            format!("below {limit} m, or a block that is let fall rests in the air"),
        );
    }
    Ok(())
}

fn error(constants: &Constants, name: &'static str, expected: String) -> Result<(), ConstantError> {
    let value = constants.value(name).unwrap_or(Value::None).to_string();
    Err(ConstantError::Value { name, value, expected })
}

/// Returns true if no mode of the springs grows.
fn is_stable(constants: &Constants, mass: f64) -> bool {
    let h = constants.force_step();
    let [a, b] = [constants.damping * h, constants.stiffness * h * h].map(|x| MAX_EIGENVALUE * x / mass);
    match constants.method {
        // Eq. 4.4 has the characteristic polynomial λ² - (2 - a - b) λ + 1 - a, whose roots are
        // within the unit circle where a <= 2 and 2 a + b <= 4 (Jury).
        Method::Euler | Method::Multi => a <= 2.0 && 2.0 * a + b <= 4.0,
        Method::Midpoint => amplification(&[0.5, 1.0, 1.0], a, b) <= 1.0,
        Method::Rk4 => amplification(&[1.0 / 24.0, 1.0 / 6.0, 0.5, 1.0, 1.0], a, b) <= 1.0,
    }
}

/// Maximum time of a frame, s, for which no mode of the springs grows.
pub fn max_frame_time(constants: &Constants, mass: f64) -> f64 {
    let stable = |time: f64| is_stable(&Constants { frame_rate: 1.0 / time, ..constants.clone() }, mass);
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..BISECTIONS {
        let middle = 0.5 * (low + high);
        if stable(middle) { low = middle } else { high = middle }
    }
    low
}

/// Maximum factor of a step for z² + a z + b = 0: the absolute value of a method's polynomial,
/// highest power first, at either root.
fn amplification(polynomial: &[f64], a: f64, b: f64) -> f64 {
    let discriminant = 0.25 * a * a - b;
    let root = discriminant.abs().sqrt();
    let roots =
        if discriminant < 0.0 { [(-0.5 * a, root); 2] } else { [(-0.5 * a - root, 0.0), (-0.5 * a + root, 0.0)] };
    let size = |(x, y): (f64, f64)| {
        let (re, im) = polynomial.iter().fold((0.0, 0.0), |(re, im), c| (re * x - im * y + c, re * y + im * x));
        (re * re + im * im).sqrt()
    };
    roots.into_iter().map(size).fold(0.0, f64::max)
}

/// Error of springs that diverge: names a constant that alone would cure it, if possible one that
/// is not at its default.
fn divergence(constants: &Constants, mass: f64) -> ConstantError {
    let default = Constants::default();
    let mut cures: Vec<(&'static str, String)> = Vec::new();
    let stiffness = |x: f64| Constants { stiffness: x, ..constants.clone() };
    let damping = |x: f64| Constants { damping: x, ..constants.clone() };
    if let Some(limit) = max_stable(2.0, constants.stiffness, |x| is_stable(&stiffness(x), mass)) {
        cures.push(("stiffness", format!("at most {limit} N/m")));
    }
    if let Some(limit) = max_stable(2e-6, constants.damping, |x| is_stable(&damping(x), mass)) {
        cures.push(("damping", format!("at most {limit} N s/m")));
    }
    let loops = |n: u32| Constants { mid_loop_count: n, ..constants.clone() };
    let max_loops = match Constant::find("mid_loop_count").map(|constant| constant.range) {
        Some(Range::Whole { max, .. }) => max,
        _ => 0,
    };
    let found = (constants.mid_loop_count..=max_loops).find(|n| is_stable(&loops(*n), mass));
    if let Some(limit) = found {
        cures.push(("mid_loop_count", format!("at least {limit}")));
    }
    let changed = cures.iter().position(|(name, _)| constants.value(name) != default.value(name));
    let step = constants.force_step();
    let (name, expected) = match cures.get(changed.unwrap_or(0)) {
        Some((name, limit)) => (*name, format!("{limit}, or springs diverge in steps of {step:.3e} s")),
        None => ("stiffness", format!("heavier blocks: one of {} kg is too light for any step", 8.0 * mass)),
    };
    let value = constants.value(name).unwrap_or(Value::None).to_string();
    ConstantError::Value { name, value, expected }
}

/// Maximum of the values from `min` to `high` for which `stable` holds, rounded down; `None` where
/// it holds for none. Explicit methods need some damping, so that it need not hold at `min`.
fn max_stable(min: f64, high: f64, stable: impl Fn(f64) -> bool) -> Option<Value> {
    let mut high = high;
    while high > min && !stable(0.5 * high) {
        high *= 0.5;
    }
    if high <= min {
        return None;
    }
    let mut low = 0.5 * high;
    for _ in 0..BISECTIONS {
        let middle = 0.5 * (low + high);
        if stable(middle) { low = middle } else { high = middle }
    }
    Some(round_down(low))
}

/// Returns a positive number rounded down to three digits.
fn round_down(x: f64) -> Value {
    let digits = 2.0 - libm::floor(libm::log10(x));
    let scale = libm::round(libm::exp10(digits.abs()));
    Value::Number(if digits > 0.0 { libm::floor(x * scale) / scale } else { libm::floor(x / scale) * scale })
}
