//! Towers that stand are not called fallen: rigid and soft, with stiff and soft contacts.

use teeter_game::{Command, Game, TowerState};
use teeter_physics::{Params, World};
use teeter_scene::{Form, Scene, Springs};

use crate::common::tower;

/// The last update of a tower that nobody touches for some seconds, and the largest drop of a block
/// in m.
fn after(scene: &Scene, seconds: f64) -> (TowerState, bool, f64) {
    let mut game = Game::new(World::new(scene, Params::default()).expect("the scene is valid"));
    let start: Vec<f64> = game.blocks().positions().iter().map(|p| p.z).collect();
    let mut last = None;
    for _ in 0..(60.0 * seconds) as u32 {
        last = Some(game.step(&Command::Idle));
    }
    let drop = start.iter().zip(game.blocks().positions()).map(|(z, p)| z - p.z).fold(0.0, f64::max);
    let last = last.expect("some frames were stepped");
    (last.tower, last.at_rest, drop)
}

#[test]
fn a_tower_with_contacts_of_the_page_stands_and_comes_to_rest() {
    for stiffness in [1e4, 3e5, 1e6, 3e6] {
        for seed in [1, 2] {
            let (state, at_rest, drop) = after(&Scene { stiffness, ..tower(18, seed) }, 3.0);
            assert_eq!((state, at_rest), (TowerState::Standing, true), "{stiffness} N/m, seed {seed}: {drop} m");
        }
    }
}

#[test]
fn a_tower_of_soft_blocks_sinks_and_stands() {
    for springs in [1e3, 1e4, 1e6] {
        let springs = Springs { stiffness: Some(springs), ..Springs::default() };
        let scene = Scene { form: Form::Lattice, springs, stiffness: 3e5, ..tower(18, 1) };
        let (state, _, drop) = after(&scene, 3.0);
        assert_ne!(state, TowerState::Fallen, "{springs:?}: {drop} m");
    }
}
