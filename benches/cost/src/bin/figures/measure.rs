//! Timing round by round, so that the load of the machine affects all workloads alike.

use std::cell::RefCell;
use std::rc::Rc;

use teeter_cost::{Clocked, CostError, Measurement, Node, Workload, one_thread, swept};
use teeter_physics::{Precision, Width};

use crate::field::{Field, threads};

/// Names of workloads and modes.
pub mod name {
    pub const AWAKE: &str = "awake";
    pub const SPRINGS: &str = "springs";
    pub const ASLEEP: &str = "asleep";
    pub const COLLAPSE: &str = "collapse";
    pub const HIT_LOW: &str = "hit low";
    pub const TALL: &str = "collapse of 40 rows";
    pub const ROWS_6: &str = "6 rows";
    pub const ROWS_60: &str = "60 rows";
    pub const SWAYING: &str = "swaying";
    pub const APART_64: &str = "64 towers apart";
    pub const TOGETHER_64: &str = "64 towers in a world";
    pub const APART_200: &str = "200 towers apart";
    pub const TOGETHER_200: &str = "200 towers in a world";
    pub const NATIVE: &str = "native";
    pub const AVX2: &str = "native, AVX2";
    pub const SIMD128: &str = "simd128";
    pub const SCALAR: &str = "scalar";
    pub const ONE_THREAD: &str = "one thread";
    pub const TWO_THREADS: &str = "two threads";
}

/// Workload in one mode, with its measurements.
pub struct Timed {
    /// Name of the workload. All modes of a workload end in the same state.
    pub workload: &'static str,
    /// Name of the mode.
    pub mode: &'static str,
    /// Playback of the measured frames.
    play: Box<dyn FnMut() -> Result<Measurement, CostError>>,
    /// Measurements, one a round.
    pub measurements: Vec<Measurement>,
}

impl Timed {
    /// Creates a workload without measurements.
    pub fn new(
        workload: &'static str,
        mode: &'static str,
        play: impl FnMut() -> Result<Measurement, CostError> + 'static,
    ) -> Self {
        Self { workload, mode, play: Box::new(play), measurements: Vec::new() }
    }
}

/// Returns all workloads, settled. Modes have one thread unless they name more.
pub fn all() -> Result<Vec<Timed>, CostError> {
    one_thread()?;
    let mut timed = Vec::new();
    let builds = [name::SIMD128, name::SCALAR];
    let nodes: Vec<_> =
        builds.iter().map(|build| Ok(Rc::new(RefCell::new(Node::start(build)?)))).collect::<Result<_, CostError>>()?;
    let workloads = [
        (name::AWAKE, Workload::awake(18, 1e6, Precision::Single)?, 2),
        (name::SPRINGS, Workload::springs()?, 1),
        (name::ASLEEP, Workload::asleep()?, 0),
        (name::COLLAPSE, Workload::golden("collapse", 60)?, 1),
        (name::HIT_LOW, swept(name::HIT_LOW, 18, 0..6, 3.0)?, 1),
        (name::TALL, swept(name::TALL, 40, 2..4, 2.0)?, 0),
        (name::ROWS_6, Workload::awake(6, 1e6, Precision::Single)?, 0),
        (name::ROWS_60, Workload::awake(60, 1e6, Precision::Single)?, 0),
        (name::SWAYING, Workload::swaying()?, 0),
    ];
    for (name, workload, in_wasm) in &workloads {
        eprintln!("{name} settles");
        let mut clocked = Clocked::new(workload)?;
        timed.push(Timed::new(name, name::NATIVE, move || clocked.play()));
        for (node, build) in nodes.iter().zip(builds).take(*in_wasm) {
            let node = Rc::clone(node);
            let number = node.borrow_mut().prepare(workload)?;
            timed.push(Timed::new(name, build, move || node.borrow_mut().play(number)));
        }
    }
    let mut clocked = Clocked::new(&Workload::awake(18, 1e6, Precision::Single)?.in_width(Width::Avx2))?;
    timed.push(Timed::new(name::AWAKE, name::AVX2, move || clocked.play()));
    let (one, two) = (Rc::new(threads(1)?), Rc::new(threads(2)?));
    let fields = [
        (name::APART_64, Field::apart(64, &two)?, &[(name::ONE_THREAD, &one), (name::TWO_THREADS, &two)][..]),
        (name::TOGETHER_64, Field::together(64, &two)?, &[(name::ONE_THREAD, &one), (name::TWO_THREADS, &two)][..]),
        (name::APART_200, Field::apart(200, &two)?, &[(name::ONE_THREAD, &one)][..]),
        (name::TOGETHER_200, Field::together(200, &two)?, &[(name::ONE_THREAD, &one)][..]),
    ];
    for (name, field, modes) in fields {
        for &(mode, pool) in modes {
            let (mut field, pool) = (field.clone(), Rc::clone(pool));
            timed.push(Timed::new(name, mode, move || field.play(&pool)));
        }
    }
    Ok(timed)
}

/// Plays all workloads in turn, each round starting with another. A first round is not counted: it
/// fills caches, and node compiles.
pub fn rounds(timed: &mut [Timed], rounds: usize) -> Result<(), CostError> {
    let all = timed.len();
    for round in 0..=rounds {
        for turn in 0..all {
            let timed = &mut timed[(round + turn) % all];
            let measurement = (timed.play)()?;
            if round > 0 {
                timed.measurements.push(measurement);
            }
        }
        eprintln!("round {round} of {rounds}");
    }
    Ok(())
}

/// Checks that all modes of a workload end in the same state.
///
/// # Errors
/// Names the first two modes that differ.
pub fn same_bits(timed: &[Timed]) -> Result<(), CostError> {
    for it in timed {
        let first = timed.iter().find(|other| other.workload == it.workload).unwrap_or(it);
        let hash = &first.measurements[0].hash;
        if let Some(other) = it.measurements.iter().find(|measurement| measurement.hash != *hash) {
            return Err(CostError::Disagreement {
                workload: it.workload.into(),
                first: first.mode.into(),
                hash: hash.clone(),
                second: it.mode.into(),
                other: other.hash.clone(),
            });
        }
    }
    Ok(())
}
