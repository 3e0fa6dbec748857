//! Target: the inputs of a run as text, which are changes over time.

use teeter_physics::{Input, Params, World};
use teeter_scene::{MAX_BYTES, Scene, read_text};
use teeter_study::{Timeline, read_inputs};

/// Number of frames that are stepped.
const FRAMES: usize = 8;
/// Blocks of the scene: their ids are 10, 20 and 30.
const BLOCKS: usize = 3;

fn scene() -> Scene {
    let mut scene = teeter_scene::named("column").expect("the list has it");
    scene.blocks.truncate(BLOCKS);
    for (block, id) in scene.blocks.iter_mut().zip([10, 20, 30]) {
        block.id = id;
    }
    scene
}

/// Reads bytes as inputs, and steps a world with those that are accepted. Changes begin in the
/// order of their times, poses stay finite, the same changes give the same bits, and an error is
/// one printable line.
pub fn run(bytes: &[u8]) {
    let scene = scene();
    let Ok(text) = read_text(bytes, MAX_BYTES) else { return };
    let timeline = match read_inputs(&text, &scene) {
        Ok(timeline) => timeline,
        Err(error) => {
            let line = error.to_string();
            assert!(!line.contains(char::is_control) && line.len() < 2000, "{line:?}");
            return;
        }
    };
    let times = timeline.pending().iter().map(|change| change.time);
    assert!(times.is_sorted_by(|a, b| a <= b && *a >= 0.0), "changes are not in the order of their times");
    let played = play(&scene, timeline.clone());
    assert_eq!(played, play(&scene, timeline));
}

/// Plays changes on a world, and returns its hash.
fn play(scene: &Scene, mut timeline: Timeline) -> u64 {
    let mut world = World::new(scene, Params::default()).expect("the scene is valid");
    for _ in 0..FRAMES {
        let input: Input = timeline.input(&world).clone();
        world.step(&input);
        assert!(world.poses().iter().all(|x| x.is_finite()));
    }
    world.hash()
}

/// Lines with every field, whole and with an error.
pub fn seeds() -> Vec<Vec<u8>> {
    let lines = [
        r#"{"time": 0, "hand": {"block": 10, "grip": "slide", "anchor": [0.04, 0, 0], "velocity": [0.08, 0, 0]}}"#,
        r#"{"time": 0.02, "hand": {"block": 30, "grip": "carry", "target": [0, 0, 0.1], "orientation": [0, 0, 0, 1]}}"#,
        r#"{"time": 0.04, "hand": {"block": 30, "grip": "push", "axis": [1, 0, 0], "max_force": 5, "max_torque": 1}}"#,
        r#"{"time": 0.06, "hand": null, "forces": [{"block": 20, "force": [0.3, 0, 0], "point": [0, 0, 0.01]}]}"#,
        r#"{"time": 0.08, "drives": [{"block": 10, "velocity": [0.1, 0, 0], "max_force": 2}], "gravity": [0, 1, -9]}"#,
        r#"{"time": 0.1, "forces": [], "drives": [], "gravity": null}"#,
        r#"{"time": 0, "hand": {"body": 11, "grip": "lift"}}"#,
    ];
    let alone = lines.iter().map(|line| line.as_bytes().to_vec());
    alone.chain([lines[..6].join("\n").into_bytes()]).collect()
}
