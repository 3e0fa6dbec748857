//! What is timed, and timing it round by round: whatever else the machine does hits all alike.

use std::cell::RefCell;
use std::rc::Rc;

use teeter_cost::{Clocked, Fault, Node, Stretch, Workload, one_thread, swept};
use teeter_physics::{Precision, Width};

use crate::field::{Field, threads};

/// The names under which figures find what was timed.
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

/// A workload in one way to run, and how long it took.
pub struct Timed {
    /// What is played: all that play the same end in the same state.
    pub what: &'static str,
    /// How.
    pub way: &'static str,
    /// Plays it once.
    play: Box<dyn FnMut() -> Result<Stretch, Fault>>,
    /// One a round.
    pub stretches: Vec<Stretch>,
}

impl Timed {
    /// Not yet timed.
    pub fn new(what: &'static str, way: &'static str, play: impl FnMut() -> Result<Stretch, Fault> + 'static) -> Self {
        Self { what, way, play: Box::new(play), stretches: Vec::new() }
    }
}

/// Everything that is timed, settled. What is not said to have more threads has one.
pub fn all() -> Result<Vec<Timed>, Fault> {
    one_thread()?;
    let mut timed = Vec::new();
    let builds = [name::SIMD128, name::SCALAR];
    let nodes: Vec<_> =
        builds.iter().map(|build| Ok(Rc::new(RefCell::new(Node::start(build)?)))).collect::<Result<_, Fault>>()?;
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
    for (what, workload, in_wasm) in &workloads {
        eprintln!("{what} settles");
        let mut clocked = Clocked::new(workload)?;
        timed.push(Timed::new(what, name::NATIVE, move || clocked.play()));
        for (node, build) in nodes.iter().zip(builds).take(*in_wasm) {
            let node = Rc::clone(node);
            let number = node.borrow_mut().prepare(workload)?;
            timed.push(Timed::new(what, build, move || node.borrow_mut().play(number)));
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
    for (what, field, ways) in fields {
        for &(way, pool) in ways {
            let (mut field, pool) = (field.clone(), Rc::clone(pool));
            timed.push(Timed::new(what, way, move || field.play(&pool)));
        }
    }
    Ok(timed)
}

/// Plays everything in turn, each round beginning with another. A round before the first is not counted: caches fill in it, and node compiles.
pub fn rounds(timed: &mut [Timed], rounds: usize) -> Result<(), Fault> {
    let all = timed.len();
    for round in 0..=rounds {
        for turn in 0..all {
            let timed = &mut timed[(round + turn) % all];
            let stretch = (timed.play)()?;
            if round > 0 {
                timed.stretches.push(stretch);
            }
        }
        eprintln!("round {round} of {rounds}");
    }
    Ok(())
}

/// Makes sure that all that play the same end in the same state, each time.
pub fn same_bits(timed: &[Timed]) -> Result<(), Fault> {
    for it in timed {
        let first = timed.iter().find(|other| other.what == it.what).unwrap_or(it);
        let hash = &first.stretches[0].hash;
        if let Some(other) = it.stretches.iter().find(|stretch| stretch.hash != *hash) {
            return Err(format!("{}: {} ends in {hash} and {} in {}", it.what, first.way, it.way, other.hash));
        }
    }
    Ok(())
}
