//! Golden results in every mode of this build. `tools/golden check` adds the other builds, and node
//! plays the same runs.

use std::path::{Path, PathBuf};

use glam::DVec3;
use teeter_game::{Event, Game, Record, verify};
use teeter_golden::{Cell, Golden, Outcome, Run, contest, mint, play_all, runs, table};
use teeter_physics::{BodyId, Input, Params, Precision, Twist, Width, World};

fn dir() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../data/golden")
}

fn golden_runs() -> Vec<Run> {
    runs(&dir()).unwrap()
}

fn run(name: &str) -> Run {
    golden_runs().into_iter().find(|run| run.name == name).unwrap()
}

/// Asserts that each run reproduces its golden result.
fn check(width: Width, threads: usize) {
    let golden = Golden::read(&dir()).unwrap();
    let runs = golden_runs();
    let names: Vec<&str> = runs.iter().map(|run| run.name.as_str()).collect();
    assert_eq!(
        names,
        golden.runs.iter().map(|run| run.name.as_str()).collect::<Vec<_>>(),
        "mint the results of the new runs"
    );
    for (name, outcome) in names.iter().zip(play_all(&runs, width, threads).unwrap()) {
        assert_eq!(
            Some(&outcome),
            golden.outcome(name),
            "run {name} in width {width:?} with {threads} threads; if the bits had to change: tools/golden mint \"why\""
        );
    }
}

/// Records of games name the engine by its bits.
#[test]
fn the_identity_of_the_engine_is_that_of_its_golden_results() {
    let bits = Golden::read(&dir()).unwrap().bits();
    let id = teeter_game::engine_id();
    assert_eq!(id.split_once('+').map(|(_, bits)| bits), Some(&*bits), "write it to crates/game/src/record/engine.rs");
}

#[test]
fn portable_gives_the_golden_results() {
    check(Width::Portable, 1);
}

#[test]
fn sse2_gives_the_golden_results() {
    check(Width::Sse2, 1);
}

/// A processor without AVX2 repeats SSE2.
#[test]
fn avx2_gives_the_golden_results() {
    check(Width::Avx2, 1);
}

/// A processor without AVX-512 repeats a narrower width.
#[test]
fn avx512_gives_the_golden_results() {
    check(Width::Avx512, 1);
}

#[test]
fn two_and_five_threads_give_the_golden_results() {
    check(Width::Auto, 2);
    check(Width::Auto, 5);
}

/// A world steps with the same bits on any thread, in turn with others.
#[test]
fn a_world_may_change_threads_between_steps() {
    let run = run("collapse");
    let mut worlds: Vec<_> = (0..3).map(|_| run.world(Width::Auto).unwrap()).collect();
    for input in &run.inputs[..80] {
        std::thread::scope(|scope| {
            for world in &mut worlds {
                scope.spawn(|| world.step(input));
            }
        });
    }
    let mut alone = run.world(Width::Auto).unwrap();
    run.inputs[..80].iter().for_each(|input| drop(alone.step(input)));
    assert!(worlds.iter().all(|world| world.hash() == alone.hash()));
}

/// Modes of the host thread: subnormals to zero in both directions, rounding towards zero.
#[cfg(target_arch = "x86_64")]
#[test]
fn the_float_mode_of_the_host_changes_no_bit() {
    use std::arch::asm;

    fn set(value: u32) {
        // SAFETY: reads four bytes; exceptions stay masked.
        unsafe { asm!("ldmxcsr [{}]", in(reg) &raw const value, options(nostack)) };
    }
    fn get() -> u32 {
        let mut value = 0_u32;
        // SAFETY: writes four bytes.
        unsafe { asm!("stmxcsr [{}]", in(reg) &raw mut value, options(nostack)) };
        value
    }
    const STANDARD: u32 = 0x1f80;
    let golden = Golden::read(&dir()).unwrap();
    for mode in [1 << 6 | 1 << 15, 3 << 13] {
        for run in [run("collapse"), run("collapse-f64")] {
            set(STANDARD | mode);
            let outcome = run.play(Width::Auto);
            let after = get();
            set(STANDARD);
            assert_eq!(after & mode, mode, "the host has its mode back");
            assert_eq!(outcome.as_ref().ok(), golden.outcome(&run.name));
        }
    }
    // The golden runs have no subnormal number; this one has little else.
    let hash = |mode: u32| {
        let mut scene = teeter_scene::named("block").unwrap();
        scene.blocks[0].pos[2] += 1.0;
        let mut world = World::new(&scene, Params::default()).unwrap();
        world.set_twist(BodyId(0), Twist::linear(DVec3::new(1e-310, 0.0, 0.0)));
        set(STANDARD | mode);
        world.step(&Input::default());
        set(STANDARD);
        assert!(world.poses()[0] > 0.0, "it went nowhere");
        world.hash()
    };
    assert_eq!(hash(0), hash(1 << 6 | 1 << 15));
}

/// The runs rest, fall and put a block on top.
#[test]
fn the_runs_rest_fall_and_put_a_block_on_top() {
    let positions = |world: &World| -> Vec<DVec3> { world.bodies().map(|body| world.pose(body).position).collect() };
    let end = |name: &str| {
        let run = run(name);
        let mut world = run.world(Width::Auto).unwrap();
        let start = positions(&world);
        run.inputs.iter().for_each(|input| drop(world.step(input)));
        (run, start, positions(&world))
    };
    let height = |positions: &[DVec3]| positions.iter().map(|p| p.z).fold(0.0, f64::max);

    let (_, start, now) = end("rest");
    assert!(height(&now) > height(&start) - 1e-3);
    for name in ["collapse", "collapse-f64"] {
        let (_, start, now) = end(name);
        let fallen = now.iter().zip(&start).filter(|(now, start)| now.z < start.z - 0.02).count();
        assert!(fallen > 30, "{name}: {fallen} blocks fell");
    }
    let (run, start, now) = end("pull");
    let body = run.inputs.iter().find_map(|input| input.hand.as_ref()).unwrap().body.index();
    let top = height(&now);
    assert_eq!(now[body].z, top);
    assert!(top > height(&start) + 0.015);
    for other in (0..now.len()).filter(|&i| i != body) {
        assert!((now[other] - start[other]).length() < 5e-3, "block {other} went along");
    }
}

#[test]
fn the_game_places_a_block_twice_and_pokes_another() {
    let run = run("game");
    let mut game = Game::new(run.world(Width::Auto).unwrap());
    let events: Vec<Event> = run.commands.iter().flat_map(|command| game.step(command).events).collect();
    let [
        Event::Grasped { body: first },
        Event::Placed { .. },
        Event::Grasped { .. },
        Event::Placed { .. },
        Event::Grasped { body: second },
        Event::Poked { .. },
    ] = events[..]
    else {
        panic!("{events:?}")
    };
    assert_ne!(first, second);
}

#[test]
fn runs_come_to_rest_and_one_has_double_precision() {
    let golden = Golden::read(&dir()).unwrap();
    assert!(golden.runs.len() >= 6);
    assert!(golden_runs().iter().any(|run| run.params.precision == Precision::Double));
    for name in ["rest", "collapse", "pull", "midgame", "official"] {
        assert!(golden.outcome(name).unwrap().step_of_rest.is_some(), "{name} does not come to rest");
    }
}

#[test]
fn minting_needs_a_reason() {
    let before = std::fs::read(dir().join("hashes.json")).unwrap();
    for reason in ["", "  ", "faster", "a b c"] {
        assert!(mint(&dir(), reason).unwrap_err().to_string().contains("reason"));
    }
    assert_eq!(std::fs::read(dir().join("hashes.json")).unwrap(), before);
}

#[test]
fn the_matrix_shows_different_and_missing_cells() {
    let golden = Golden::read(&dir()).unwrap();
    let cells = |column: &str| -> Vec<Cell> {
        let cell =
            |m: &teeter_golden::Minted| Cell { column: column.into(), run: m.name.clone(), outcome: m.outcome.clone() };
        golden.runs.iter().map(cell).collect()
    };
    let mut all = [cells("one"), cells("two")].concat();
    let again: Vec<Cell> = all.iter().map(|cell| Cell::parse(&cell.line()).unwrap()).collect();
    assert_eq!(again, all);
    assert!(table(&golden, &all).1);
    assert!(!table(&golden, &[]).1, "an empty matrix proves nothing");
    all[1].outcome.hash = "0123456789abcdef".into();
    let (text, equal) = table(&golden, &all);
    assert!(!equal && text.contains("0123456789abcdef"));
    all[1].outcome = Outcome { step_of_rest: Some(7), ..golden.runs[1].outcome.clone() };
    assert!(!table(&golden, &all).1);
    all.remove(1);
    let (text, equal) = table(&golden, &all);
    assert!(!equal && text.contains("missing"));
}

/// Node plays the same game on the page's engine.
#[test]
fn two_opponents_play_the_recorded_game_again_bit_for_bit() {
    let bytes = std::fs::read(dir().join("contest.record")).unwrap();
    let recorded = Record::decode(&bytes).unwrap();
    let played = Record::decode(&contest().unwrap()).unwrap();
    assert!(recorded == played, "if opponents or bits had to change: tools/golden record");
    assert!(verify(&recorded).unwrap().same);
}
