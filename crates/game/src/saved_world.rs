//! A world as bytes with all that it follows from, so that another program or thread can go on with
//! it.

use serde::{Deserialize, Serialize};
use teeter_physics::envelope::{EnvelopeError, open, seal};
use teeter_physics::{Params, Width, World, numbers_within};
use teeter_scene::Scene;

use crate::simulator::Simulator;
use crate::snapshot::RestoreError;
use crate::stiffness_ramp::BlockForm;

/// Kind of the bytes: name and version of their layout.
const KIND: &[u8] = b"teeter-world\x00\x01";

/// Content: the scene as JSON, the constants of the run, the form of the blocks and the state.
#[derive(Serialize, Deserialize)]
struct Content {
    scene: String,
    params: Params,
    form: BlockForm,
    state: Vec<u8>,
}

/// Returns a world as bytes: scene, constants of the run and state.
///
/// # Panics
/// Never: the content is text and plain numbers, which can always be written.
///
/// ```
/// use teeter_game::{load_world, save_world};
/// use teeter_physics::{Params, World};
///
/// let mut world = World::new(&teeter_scene::named("column").unwrap(), Params::default())?;
/// world.run_for(0.5);
/// let loaded = load_world(&save_world(&world)).unwrap();
/// assert_eq!((loaded.hash(), loaded.time()), (world.hash(), world.time()));
/// assert!(load_world(b"{}").is_err());
/// # Ok::<(), teeter_physics::BuildError>(())
/// ```
pub fn save_world(world: &World) -> Vec<u8> {
    let content = Content {
        scene: world.scene().to_json(),
        // The register width is that of the machine, and changes no bit.
        params: Params { width: Width::Auto, ..*world.params() },
        form: world.block_form(),
        state: world.snapshot(),
    };
    seal(KIND, &postcard::to_stdvec(&content).expect("text and plain numbers can always be written"))
}

/// Builds the world of [`save_world`]; it goes on bit for bit.
///
/// # Errors
/// When the bytes are none of a world, or anything in them has changed.
pub fn load_world(bytes: &[u8]) -> Result<World, RestoreError> {
    let content = open(KIND, bytes).map_err(|error| match error {
        EnvelopeError::Kind => RestoreError::Magic,
        EnvelopeError::Damaged => RestoreError::Damaged,
    })?;
    let Ok((content, [])) = postcard::take_from_bytes::<Content>(content) else {
        return Err(RestoreError::Damaged);
    };
    if !numbers_within(&content.form, f64::MAX) {
        return Err(RestoreError::Damaged);
    }
    let refused = |error: String| RestoreError::World(error);
    let scene = Scene::from_json(&content.scene).map_err(|error| refused(error.to_string()))?;
    let mut world = World::new(&scene, content.params).map_err(|error| refused(error.to_string()))?;
    world.set_block_form(content.form).map_err(refused)?;
    world.restore(&content.state).map_err(|error| refused(error.to_string()))?;
    Ok(world)
}

#[cfg(test)]
mod tests {
    use teeter_scene::{Form, TowerOptions, tower};

    use super::*;

    #[test]
    fn a_world_of_soft_blocks_that_moves_goes_on_with_the_same_bits() {
        let scene = tower(&TowerOptions { rows: 3, ..TowerOptions::default() }).unwrap();
        let mut world = World::new(&scene, Params::default()).unwrap();
        world.set_block_form(BlockForm { form: Form::Lattice, spring_stiffness: 2e5 }).unwrap();
        world.run_for(0.2);
        let mut loaded = load_world(&save_world(&world)).unwrap();
        world.run_for(0.3);
        loaded.run_for(0.3);
        assert_eq!((loaded.hash(), loaded.block_form()), (world.hash(), world.block_form()));
    }

    #[test]
    fn bytes_that_are_changed_or_end_early_are_refused() {
        let bytes = save_world(&World::new(&teeter_scene::named("block").unwrap(), Params::default()).unwrap());
        for cut in 0..bytes.len() {
            assert!(load_world(&bytes[..cut]).is_err(), "{cut} bytes");
            let mut changed = bytes.clone();
            changed[cut] ^= 0x20;
            assert!(load_world(&changed).is_err(), "byte {cut}");
        }
    }
}
