//! Target: a snapshot of a world, whole or sealed again.

use teeter_physics::envelope::seal;
use teeter_physics::{Input, Params, World};
use teeter_scene::Form;

/// Kind of a snapshot of a world.
const KIND: &[u8] = b"teeter\x00\x05";
/// Bytes of an envelope before the content.
const ENVELOPE: usize = KIND.len() + 16;

fn world(form: Form) -> World {
    let mut scene = teeter_scene::named("column").expect("the list has it");
    scene.blocks.truncate(3);
    scene.form = form;
    World::new(&scene, Params::default()).expect("the scene is valid")
}

/// Restores bytes: whole after a first byte that is even, else sealed as the content of a snapshot.
/// What is refused leaves the world as it was, and what is accepted can be stepped and stored.
pub fn run(bytes: &[u8]) {
    let Some((&first, bytes)) = bytes.split_first() else { return };
    let mut world = world(if first & 2 == 0 { Form::Rigid } else { Form::Lattice });
    let before = world.hash();
    let restored = if first & 1 == 0 { world.restore(bytes) } else { world.restore(&seal(KIND, bytes)) };
    if restored.is_err() {
        assert_eq!(world.hash(), before, "a refused snapshot changed the world");
        return;
    }
    world.restore(&world.snapshot()).expect("what was restored can be stored and restored");
    world.step(&Input::default());
    assert!(world.poses().iter().all(|x| x.is_finite()));
}

/// Snapshots of both forms, whole and as contents.
pub fn seeds() -> Vec<Vec<u8>> {
    let of = |form: Form, flag: u8| {
        let mut world = world(form);
        world.run_for(0.1);
        let bytes = world.snapshot();
        [[&[flag], &bytes[..]].concat(), [&[flag | 1], &bytes[ENVELOPE..]].concat()]
    };
    [of(Form::Rigid, 0), of(Form::Lattice, 2)].concat()
}
