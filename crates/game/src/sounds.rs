//! Sounds of a world: impacts and sliding contacts of a frame.
//!
//! A contact between two frames is over within a millisecond, so most impacts leave no trace in the
//! contacts at the end of a frame. They are found by what neither rest, nor free fall, nor the hand
//! explains in the velocity of a body. Nothing here acts on the world.

use glam::DVec3;
use teeter_physics::{BodyId, ContactReport, Twist, World};

/// Speed of approach from which the first touch of two bodies is an impact, m/s.
const TOUCH: f64 = 0.015;
/// Change of a body's velocity within a frame from which it is an impact, m/s: a block that topples
/// falls by less than gravity, and that much beside it.
const JOLT: f64 = 0.1;
/// Relative speed from which a contact slides, m/s.
const SLIP: f64 = 0.002;
/// Speed of a body below which its contacts are silent, m/s.
const STILL: f64 = 0.001;

/// Sound of a frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Sound {
    /// Two bodies, or a body and the floor, hit each other.
    Impact {
        /// Body that was hit.
        body: BodyId,
        /// Impulse, N s.
        impulse: f64,
        /// Change of the speed, m/s.
        speed: f64,
        /// Position, m.
        point: DVec3,
    },
    /// Two bodies, or a body and the floor, slide on each other.
    Slide {
        /// Body that slides.
        body: BodyId,
        /// Normal force, N.
        force: f64,
        /// Relative speed, m/s.
        speed: f64,
        /// Position, m.
        point: DVec3,
    },
}

impl Sound {
    /// Impulse of an impact, N s, or power of a slide before friction, W.
    fn strength(&self) -> f64 {
        match self {
            Sound::Impact { impulse, .. } => *impulse,
            Sound::Slide { force, speed, .. } => force * speed,
        }
    }
}

/// Listens to a world, frame by frame. It remembers the last frame and is no part of the state of a
/// game: a listener that begins later hears the same.
///
/// ```
/// use teeter_game::{Listener, Sound};
/// use teeter_physics::{Params, World};
///
/// let mut world = World::new(&teeter_scene::named("pile").unwrap(), Params::default())?;
/// let mut listener = Listener::new(&world);
/// let mut loudest: f64 = 0.0;
/// for _ in 0..60 {
///     world.step(&Default::default());
///     for sound in listener.hear(&world, None) {
///         if let Sound::Impact { impulse, .. } = sound {
///             loudest = loudest.max(impulse);
///         }
///     }
/// }
/// // blocks of 20 g fall and hit each other
/// assert!(loudest > 0.005 && loudest < 0.1, "{loudest} N s");
/// # Ok::<(), teeter_physics::BuildError>(())
/// ```
#[derive(Debug, Clone)]
pub struct Listener {
    twists: Vec<Twist>,
    time: f64,
    /// Pairs that touched, in order; the floor is the largest number.
    pairs: Vec<(u32, u32)>,
}

impl Listener {
    /// Most impacts of a frame, and most slides.
    pub const MOST: [usize; 2] = [8, 3];

    /// Begins to listen to a world.
    pub fn new(world: &World) -> Self {
        Self { twists: world.bodies().map(|body| world.twist(body)).collect(), time: world.time(), pairs: Vec::new() }
    }

    /// Hears the frame that the world has just finished: impacts first, then slides, the strongest
    /// first. `held` is the body in a hand, which moves it without a sound.
    pub fn hear(&mut self, world: &World, held: Option<BodyId>) -> Vec<Sound> {
        let now = world.bodies().map(|body| world.twist(body)).collect();
        let before = std::mem::replace(&mut self.twists, now);
        let fall = DVec3::Z * (-world.scene().gravity * (world.time() - self.time));
        let frame = Frame { world, before: &before, after: &self.twists, touched: &self.pairs };
        let mut heard = Heard::default();
        for body in world.bodies().filter(|&body| frame.moves(body)) {
            let contacts = world.contacts(body);
            let hardest = frame.hear_contacts(body, &contacts, &mut heard);
            let jolt = unexplained(frame.after[body.index()].velocity - frame.before[body.index()].velocity, fall);
            if held != Some(body) && jolt > JOLT && jolt > hardest {
                let point = strongest(&contacts).unwrap_or(world.pose(body).position);
                heard.impacts.push(Sound::Impact { body, impulse: world.mass(body) * jolt, speed: jolt, point });
            }
        }
        self.time = world.time();
        self.pairs = heard.pairs;
        self.pairs.sort_unstable();
        let [mut impacts, mut slides] = [heard.impacts, heard.slides];
        keep(&mut impacts, Self::MOST[0]);
        keep(&mut slides, Self::MOST[1]);
        impacts.append(&mut slides);
        impacts
    }
}

/// Sounds of a frame so far.
#[derive(Default)]
struct Heard {
    impacts: Vec<Sound>,
    slides: Vec<Sound>,
    pairs: Vec<(u32, u32)>,
}

/// A frame between two states.
struct Frame<'a> {
    world: &'a World,
    before: &'a [Twist],
    after: &'a [Twist],
    touched: &'a [(u32, u32)],
}

impl Frame<'_> {
    /// Returns true if a body is not still, before or after the frame.
    fn moves(&self, body: BodyId) -> bool {
        let reach = self.world.size(body).length() / 2.0;
        let speed = |twist: &Twist| twist.velocity.length() + twist.spin.length() * reach;
        speed(&self.before[body.index()]).max(speed(&self.after[body.index()])) > STILL
    }

    /// Hears the contacts of a body that moves; returns the largest speed of an impact, m/s.
    fn hear_contacts(&self, body: BodyId, contacts: &[ContactReport], heard: &mut Heard) -> f64 {
        let mut hardest: f64 = 0.0;
        for contact in contacts {
            let approach = -self.relative(self.before, body, contact).dot(contact.normal);
            let pair = pair_of(body, contact.other);
            let first = self.touched.binary_search(&pair).is_err() && approach > TOUCH;
            if first {
                hardest = hardest.max(approach);
            }
            // A pair that moves is heard once.
            if contact.other.is_some_and(|other| other < body && self.moves(other)) {
                continue;
            }
            heard.pairs.push(pair);
            if first {
                let impulse = approach * self.effective_mass(body, contact.other);
                heard.impacts.push(Sound::Impact { body, impulse, speed: approach, point: contact.point });
            }
            let motion = self.relative(self.after, body, contact);
            let speed = motion.reject_from_normalized(contact.normal).length();
            if speed > SLIP {
                heard.slides.push(Sound::Slide { body, force: contact.force, speed, point: contact.point });
            }
        }
        hardest
    }

    /// Velocity of a body at a contact relative to the other, m/s.
    fn relative(&self, twists: &[Twist], body: BodyId, contact: &ContactReport) -> DVec3 {
        let at = |b: BodyId| twists[b.index()].velocity_at(contact.point - self.world.pose(b).position);
        at(body) - contact.other.map_or(DVec3::ZERO, at)
    }

    /// Mass that an impact of two bodies acts on, kg; that of the body for the floor.
    fn effective_mass(&self, body: BodyId, other: Option<BodyId>) -> f64 {
        1.0 / (1.0 / self.world.mass(body) + other.map_or(0.0, |b| 1.0 / self.world.mass(b)))
    }
}

/// Keeps the `most` strongest sounds, the strongest first.
fn keep(sounds: &mut Vec<Sound>, most: usize) {
    sounds.sort_by(|a, b| b.strength().total_cmp(&a.strength()));
    sounds.truncate(most);
}

/// Part of a change of velocity that is neither rest nor a part of free fall, m/s: its distance
/// from the line between the two.
fn unexplained(change: DVec3, fall: DVec3) -> f64 {
    let along = if fall == DVec3::ZERO { 0.0 } else { change.dot(fall) / fall.length_squared() };
    change.distance(fall * along.clamp(0.0, 1.0))
}

/// Names a pair by the order of its bodies.
fn pair_of(body: BodyId, other: Option<BodyId>) -> (u32, u32) {
    let other = other.map_or(u32::MAX, |b| b.0);
    (body.0.min(other), body.0.max(other))
}

/// Position of the contact with the largest force, m.
fn strongest(contacts: &[ContactReport]) -> Option<DVec3> {
    contacts.iter().max_by(|a, b| a.force.total_cmp(&b.force)).map(|c| c.point)
}

#[cfg(test)]
mod tests {
    use teeter_physics::{Drive, Input, Params};
    use teeter_scene::named;

    use super::*;

    const FRAME: f64 = 1.0 / 60.0;

    fn listen(world: &mut World, input: &Input, frames: usize) -> Vec<(f64, Vec<Sound>)> {
        let mut listener = Listener::new(world);
        let mut heard = Vec::new();
        for _ in 0..frames {
            world.step(input);
            heard.push((world.time(), listener.hear(world, None)));
        }
        heard
    }

    #[test]
    fn a_tower_at_rest_is_silent() {
        let mut world = World::new(&named("tower").unwrap(), Params { sleep: false, ..Params::default() }).unwrap();
        let heard = listen(&mut world, &Input::default(), 120);
        assert!(heard.iter().all(|(_, sounds)| sounds.is_empty()), "{heard:?}");
    }

    #[test]
    fn a_dropped_block_is_heard_when_it_lands_with_its_momentum_and_not_before() {
        let height = 0.05;
        let mut scene = named("block").unwrap();
        scene.blocks[0].pos[2] += height;
        let mut world = World::new(&scene, Params::default()).unwrap();
        let mass = world.mass(BodyId(0));
        let heard = listen(&mut world, &Input::default(), 30);
        let (time, sounds) = heard.iter().find(|(_, sounds)| !sounds.is_empty()).expect("it lands");
        let (fall, speed) = ((2.0 * height / scene.gravity).sqrt(), (2.0 * height * scene.gravity).sqrt());
        assert!(*time > fall && *time < fall + 1.5 * FRAME, "heard at {time} s, landed at {fall} s");
        let Sound::Impact { impulse, .. } = sounds[0] else { panic!("no impact: {sounds:?}") };
        // It stops, or leaves with at most its speed.
        let momentum = mass * speed;
        assert!(impulse > 0.8 * momentum && impulse < 2.0 * momentum, "{impulse} N s of {momentum} N s");
    }

    #[test]
    fn a_block_that_is_drawn_over_the_floor_slides_with_its_weight_at_its_speed_and_hits_nothing() {
        let mut world = World::new(&named("block").unwrap(), Params::default()).unwrap();
        let velocity = DVec3::X * 0.05;
        let drive = Drive { body: BodyId(0), velocity, max_force: 5.0 };
        let input = Input { drives: vec![drive], ..Input::default() };
        world.run_with(0.5, &input);
        let heard = listen(&mut world, &input, 20);
        let weight = world.mass(BodyId(0)) * world.scene().gravity;
        for (_, sounds) in heard {
            let [Sound::Slide { force, speed, .. }] = sounds[..] else { panic!("not one slide: {sounds:?}") };
            assert!((force / weight - 1.0).abs() < 0.05 && (speed / 0.05 - 1.0).abs() < 0.05, "{force} N, {speed} m/s");
        }
    }

    #[test]
    fn listening_changes_no_bit() {
        let scene = named("pile").unwrap();
        let [mut alone, mut heard] = [(); 2].map(|()| World::new(&scene, Params::default()).unwrap());
        alone.run_for(0.5);
        listen(&mut heard, &Input::default(), 30);
        assert_eq!(alone.hash(), heard.hash());
    }

    #[test]
    fn no_frame_of_a_collapse_has_more_sounds_than_the_most() {
        let mut world = World::new(&named("pile").unwrap(), Params::default()).unwrap();
        let heard = listen(&mut world, &Input::default(), 60);
        let most = |slide: bool| {
            let count = |sounds: &[Sound]| sounds.iter().filter(|s| matches!(s, Sound::Slide { .. }) == slide).count();
            heard.iter().map(|(_, sounds)| count(sounds)).max().unwrap()
        };
        assert_eq!([most(false), most(true)], Listener::MOST);
    }
}
