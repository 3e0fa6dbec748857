//! Counting of instructions: the measured frames of a workload, played by this program under
//! valgrind.
//!
//! The workload settles here at full speed and is passed as a snapshot. Callgrind counts only the
//! time inside of [`teeter_counted`].

use std::path::Path;
use std::process::Command;

use teeter_cost::{CostError, Count, Workload, hex, one_thread};
use teeter_physics::{Input, World};

/// Plays frames and returns the number of substeps. Callgrind finds the function by this name, so
/// it must be neither renamed nor inlined.
#[unsafe(no_mangle)]
#[inline(never)]
fn teeter_counted(world: &mut World, inputs: &[Input]) -> u32 {
    inputs.iter().map(|input| world.step(input).substeps).sum()
}

/// Plays the measured frames from a snapshot and returns the number of substeps and the hash.
///
/// # Errors
/// When the snapshot does not belong to this workload.
pub fn play(workload: &Workload, state: &Path) -> Result<(u32, String), CostError> {
    // Callgrind counts in the thread that enters the function.
    one_thread()?;
    let bytes = std::fs::read(state).map_err(|e| CostError::file(state.display(), e))?;
    let (mut world, inputs) = (workload.world()?, workload.measured());
    world.restore(&bytes)?;
    let substeps = teeter_counted(&mut world, &inputs);
    Ok((substeps, hex(world.hash())))
}

/// Counts a workload.
///
/// # Errors
/// When valgrind cannot be started, or its result differs from that of the processor.
pub fn count(workload: &Workload) -> Result<Count, CostError> {
    let name = &workload.name;
    let error = |message: String| CostError::Count { workload: name.clone(), message };
    let io = |e: std::io::Error| error(e.to_string());
    let folder = tempfile::tempdir().map_err(io)?;
    let (state, profile) = (folder.path().join("state"), folder.path().join("profile"));
    let mut world = workload.settled()?;
    std::fs::write(&state, world.snapshot()).map_err(io)?;
    let program = std::env::current_exe().map_err(io)?;
    let done = Command::new("valgrind")
        .args(["--quiet", "--tool=callgrind", "--toggle-collect=teeter_counted"])
        .arg(format!("--callgrind-out-file={}", profile.display()))
        .arg(program)
        .args(["play", name])
        .arg(&state)
        .output()
        .map_err(CostError::Valgrind)?;
    let (output, messages) = (String::from_utf8_lossy(&done.stdout), String::from_utf8_lossy(&done.stderr));
    if !done.status.success() {
        return Err(error(format!("under valgrind it ended with {}: {}", done.status, messages.trim())));
    }
    let mut words = output.split_whitespace();
    let (substeps, hash) = (words.next().and_then(|word| word.parse().ok()), words.next());
    let (Some(substeps), Some(hash)) = (substeps, hash) else {
        return Err(error(format!("under valgrind it printed {output:?}")));
    };

    workload.measured().iter().for_each(|input| drop(world.step(input)));
    if hash != hex(world.hash()) {
        return Err(error("valgrind ends in another state than the processor".into()));
    }
    let profile = std::fs::read_to_string(&profile).map_err(io)?;
    let total =
        profile.lines().find_map(|line| line.strip_prefix("totals:")).and_then(|total| total.trim().parse().ok());
    let instructions =
        total.filter(|&total: &u64| total > 0).ok_or_else(|| error("valgrind counted nothing".into()))?;
    Ok(Count { name: name.clone(), frames: workload.frames as u32, substeps, instructions, hash: hash.to_owned() })
}
