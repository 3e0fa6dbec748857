//! Counting instructions: the measured frames of a workload, played by this program under valgrind.
//!
//! The workload is settled here, at full speed, and handed over as a snapshot. Valgrind's callgrind counts from where [`teeter_counted`]
//! is entered to where it is left, and nothing else.

use std::path::Path;
use std::process::Command;

use teeter_cost::{Count, Fault, Workload, hex, one_thread};
use teeter_physics::{Input, World};

/// Plays frames; returns the substeps done. Callgrind finds it by this name, so it must neither be renamed nor become a part of its
/// caller.
#[unsafe(no_mangle)]
#[inline(never)]
fn teeter_counted(world: &mut World, inputs: &[Input]) -> u32 {
    inputs.iter().map(|input| world.step(input).substeps).sum()
}

/// Plays the measured frames from a state on; what a count is taken of. Returns substeps and hash.
///
/// # Errors
/// When the state is none of this workload.
pub fn play(workload: &Workload, state: &Path) -> Result<(u32, String), Fault> {
    // callgrind counts in the thread that has entered the function
    one_thread()?;
    let bytes = std::fs::read(state).map_err(|e| format!("{}: {e}", state.display()))?;
    let (mut world, inputs) = (workload.world()?, workload.measured());
    world.restore(&bytes).map_err(|e| e.to_string())?;
    let substeps = teeter_counted(&mut world, &inputs);
    Ok((substeps, hex(world.hash())))
}

/// Counts a workload.
///
/// # Errors
/// When valgrind cannot be started or computes something else than the processor.
pub fn count(workload: &Workload) -> Result<Count, Fault> {
    let name = &workload.name;
    let fault = |what: &str| format!("{name}: {what}");
    let folder = tempfile::tempdir().map_err(|e| fault(&e.to_string()))?;
    let (state, profile) = (folder.path().join("state"), folder.path().join("profile"));
    let mut world = workload.settled()?;
    std::fs::write(&state, world.snapshot()).map_err(|e| fault(&e.to_string()))?;
    let program = std::env::current_exe().map_err(|e| fault(&e.to_string()))?;
    let done = Command::new("valgrind")
        .args(["--quiet", "--tool=callgrind", "--toggle-collect=teeter_counted"])
        .arg(format!("--callgrind-out-file={}", profile.display()))
        .arg(program)
        .args(["play", name])
        .arg(&state)
        .output()
        .map_err(|e| format!("valgrind: {e}; tools/setup valgrind installs it"))?;
    let (said, complaint) = (String::from_utf8_lossy(&done.stdout), String::from_utf8_lossy(&done.stderr));
    if !done.status.success() {
        return Err(fault(&format!("under valgrind it ended with {}: {}", done.status, complaint.trim())));
    }
    let mut words = said.split_whitespace();
    let (substeps, hash) = (words.next().and_then(|word| word.parse().ok()), words.next());
    let (Some(substeps), Some(hash)) = (substeps, hash) else {
        return Err(fault(&format!("under valgrind it said {said:?}")));
    };

    workload.measured().iter().for_each(|input| drop(world.step(input)));
    if hash != hex(world.hash()) {
        return Err(fault("valgrind does not compute what the processor does"));
    }
    let profile = std::fs::read_to_string(&profile).map_err(|e| fault(&e.to_string()))?;
    let total =
        profile.lines().find_map(|line| line.strip_prefix("totals:")).and_then(|total| total.trim().parse().ok());
    let instructions = total.filter(|&total: &u64| total > 0).ok_or_else(|| fault("valgrind has counted nothing"))?;
    Ok(Count { name: name.clone(), frames: workload.frames as u32, substeps, instructions, hash: hash.to_owned() })
}
