//! `counts`: counts the instructions of the workloads and compares them with the accepted ones. `tools/counts` calls it from the root of
//! the repository.

mod callgrind;

use std::path::Path;
use std::process::ExitCode;

use rayon::prelude::*;
use teeter_cost::{Baseline, COMPILER, Count, Fault, Workload, compare, counted};

fn main() -> ExitCode {
    let args: Vec<String> = std::env::args().skip(1).collect();
    match run(Path::new("data/baselines/instructions.json"), &args.iter().map(String::as_str).collect::<Vec<_>>()) {
        Ok(good) => ExitCode::from(u8::from(!good)),
        Err(fault) => {
            eprintln!("counts: {fault}");
            ExitCode::from(2)
        }
    }
}

/// Whether all is as it should be.
fn run(file: &Path, args: &[&str]) -> Result<bool, Fault> {
    match args {
        ["check"] => check(file),
        ["accept", reason] => accept(file, reason).map(|()| true),
        ["play", name, state] => {
            let workload = counted()?.into_iter().find(|w| w.name == *name).ok_or("there is no such workload")?;
            let (substeps, hash) = callgrind::play(&workload, Path::new(state))?;
            println!("{substeps} {hash}");
            Ok(true)
        }
        _ => Err("expected check or accept \"the reason\"".into()),
    }
}

fn check(file: &Path) -> Result<bool, Fault> {
    let baseline = Baseline::read(file)?;
    let (workloads, left_out) = playable()?;
    let comparison = compare(Some(&baseline), &count_all(&workloads)?, COMPILER, &left_out);
    print!("{}", comparison.table);
    comparison.notes.iter().for_each(|note| println!("{note}"));
    comparison.faults.iter().for_each(|fault| println!("FAULT {fault}"));
    match comparison.faults.as_slice() {
        [] => println!("nothing costs more than it may"),
        _ => println!("If this is meant: tools/counts accept \"what made it so\""),
    }
    Ok(comparison.faults.is_empty())
}

/// Makes the counts of now the accepted ones.
fn accept(file: &Path, reason: &str) -> Result<(), Fault> {
    let reason = teeter_golden::reason("the counts", reason)?.to_owned();
    let (workloads, left_out) = playable()?;
    if !left_out.is_empty() {
        return Err(format!("nothing was accepted: this processor cannot play {}", left_out.join("; ")));
    }
    let counts = count_all(&workloads)?;
    let before = Baseline::read(file).ok();
    print!("{}", compare(before.as_ref(), &counts, COMPILER, &[]).table);
    if before.is_some_and(|before| before.counts == counts && before.compiler == COMPILER) {
        println!("no count has changed: the baseline stays as it is, with its reason");
        return Ok(());
    }
    Baseline { reason, compiler: COMPILER.into(), counts }.write(file)?;
    println!("accepted, in {}", file.display());
    Ok(())
}

/// The workloads that this processor can play, and the names of the others: it would take narrower registers for them, and the count would
/// be that of another program.
fn playable() -> Result<(Vec<Workload>, Vec<String>), Fault> {
    let (playable, others): (Vec<_>, Vec<_>) =
        counted()?.into_iter().partition(|workload| workload.params.width.available());
    Ok((playable, others.into_iter().map(|workload| workload.name).collect()))
}

/// Counts all of them, as many side by side as there are cores: a count does not depend on what runs beside it.
fn count_all(workloads: &[Workload]) -> Result<Vec<Count>, Fault> {
    workloads.par_iter().map(callgrind::count).collect()
}
