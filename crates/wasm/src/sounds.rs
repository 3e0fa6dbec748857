//! Sounds of a game as numbers.

use teeter_game::Sound;
use wasm_bindgen::prelude::*;

use crate::game::Game;

/// Listens to a game, frame by frame. It acts on nothing.
#[wasm_bindgen]
#[derive(Debug)]
pub struct Listener {
    listener: teeter_game::Listener,
}

#[wasm_bindgen]
impl Listener {
    /// Begins to listen to a game.
    #[wasm_bindgen(constructor)]
    pub fn new(game: &Game) -> Listener {
        Self { listener: teeter_game::Listener::new(game.inner().world()) }
    }

    /// Hears the last frame: seven numbers a sound, impacts first, the strongest first. A number is
    /// 0 for an impact and 1 for a slide; then come the body, the impulse (N s) or the normal force
    /// (N), the speed (m/s), and the position (m).
    pub fn hear(&mut self, game: &Game) -> Vec<f32> {
        hear(&mut self.listener, game.inner())
    }
}

/// Hears the last frame of a game, with the numbers of `Listener.hear`.
pub(crate) fn hear(listener: &mut teeter_game::Listener, game: &teeter_game::Game) -> Vec<f32> {
    let world = game.world();
    let held = world.bodies().find(|&body| game.hold_grip(body).is_some());
    listener.hear(world, held).iter().flat_map(numbers).collect()
}

fn numbers(sound: &Sound) -> [f32; 7] {
    let (kind, body, strength, speed, point) = match *sound {
        Sound::Impact { body, impulse, speed, point } => (0.0, body, impulse, speed, point),
        Sound::Slide { body, force, speed, point } => (1.0, body, force, speed, point),
    };
    let [x, y, z] = point.as_vec3().to_array();
    [kind, body.0 as f32, strength as f32, speed as f32, x, y, z]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sound_is_seven_numbers_and_a_fall_is_heard() {
        let scene = crate::named_scene("pile").unwrap();
        let mut game = Game::new(&scene, "", None).unwrap();
        let mut listener = Listener::new(&game);
        let mut heard = Vec::new();
        for _ in 0..40 {
            game.step("").unwrap();
            heard.extend(listener.hear(&game));
        }
        assert!(!heard.is_empty() && heard.len() % 7 == 0);
        let blocks = game.length() as f32;
        for sound in heard.chunks(7) {
            let [kind, body, strength, speed, ..] = *sound else { panic!("{sound:?}") };
            assert!((kind == 0.0 || kind == 1.0) && body < blocks && strength > 0.0 && speed > 0.0, "{sound:?}");
        }
    }
}
