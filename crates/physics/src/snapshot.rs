//! Snapshots of the state, and its hash.

use glam::DVec3;
use serde::{Deserialize, Serialize};
use teeter_scene::Form;

use crate::actuator::hand::HandTarget;
use crate::body::Bodies;
use crate::body_id::BodyId;
use crate::bounded::numbers_within;
use crate::cluster::Cluster;
use crate::cluster::partition::Clusters;
use crate::collision::contacts::Contacts;
use crate::envelope::{EnvelopeError, open, seal};
use crate::input::AppliedForce;
use crate::lattice::particles::Particles;
use crate::valid_state;
use crate::world::World;

/// Error of [`World::restore`].
///
/// ```
/// use teeter_physics::{Params, SnapshotError, World};
///
/// let build = |name| World::new(&teeter_scene::named(name).unwrap(), Params::default());
/// let (mut block, column) = (build("block")?, build("column")?);
/// assert_eq!(block.restore(b"nonsense"), Err(SnapshotError::Header));
/// let found = column.len();
/// let error = block.restore(&column.snapshot()).unwrap_err();
/// assert_eq!(error, SnapshotError::BodyCount { found, expected: 1 });
/// # Ok::<(), teeter_physics::BuildError>(())
/// ```
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum SnapshotError {
    /// The bytes do not begin with the header of a snapshot of this version.
    #[error("not a snapshot of this world: its header is missing or of another version")]
    Header,
    /// The snapshot holds another number of bodies.
    #[error("not a snapshot of this world: it has {found} bodies instead of {expected}")]
    BodyCount {
        /// Bodies in the snapshot.
        found: usize,
        /// Bodies in the world.
        expected: usize,
    },
    /// The snapshot holds blocks of the other form.
    #[error("not a snapshot of this world: its blocks {}", match .found { Form::Rigid => "are rigid", Form::Lattice => "have springs" })]
    Form {
        /// Form of the blocks in the snapshot.
        found: Form,
    },
    /// The bytes are damaged, or hold a state that no world of this scene can have.
    #[error("not a snapshot of this world: it is damaged")]
    Damaged,
}

/// Kind of a snapshot: name and version of its layout.
const KIND: &[u8] = b"teeter\x00\x06";
/// First bytes that [`World::hash`] covers, before the state: its version. Equal states keep their
/// hash when only the envelope of the snapshot changes.
const HASH_VERSION: &[u8] = b"teeter\x00\x05";

/// Maximum of all numbers of a state, in their units: far above any that a world comes to, and its
/// square is within single precision.
const MAX_NUMBER: f64 = 1e15;

/// All state that changes: with the constants and the inputs it determines all of the future.
#[derive(Debug, Serialize, Deserialize)]
struct State {
    time: f64,
    bodies: Bodies,
    contacts: Contacts,
    /// Bodies of each cluster, and true where one has left its swept bounds.
    clusters: Vec<(Vec<u32>, bool)>,
    hand_target: Option<HandTarget>,
    forces: Vec<AppliedForce>,
    gravity: DVec3,
}

impl State {
    /// Returns true if it can be a state of `world`, a cluster of all bodies, of which those in
    /// `fixed` are held: nothing is missing, out of range or not finite.
    fn is_valid(&self, world: &Cluster, fixed: &[bool]) -> bool {
        let n = world.len();
        let mut ids: Vec<u32> = self.clusters.iter().flat_map(|(ids, _)| ids.iter().copied()).collect();
        ids.sort_unstable();
        let bounds = || self.contacts.bounds.iter().chain(&self.contacts.swept);
        let known = |body: BodyId| body.index() < n;
        self.bodies.has_len(n)
            && self.contacts.bounds.len() == n
            && self.contacts.swept.len() == n
            && numbers_within(self, MAX_NUMBER)
            && self.time >= 0.0
            && self.bodies.fixed == fixed
            && valid_state::are_bodies(&self.bodies, &world.shapes)
            && valid_state::are_manifolds(&self.contacts.manifolds, n)
            && valid_state::are_cached(&self.contacts.cache, n)
            && bounds().all(|bound| bound.min.cmple(bound.max).all())
            && self.clusters.iter().all(|(ids, _)| !ids.is_empty() && ids.is_sorted())
            && ids.into_iter().eq(0..n as u32)
            && self.forces.iter().all(|f| known(f.body))
            && self.hand_target.is_none_or(|t| known(t.body) && t.orientation.is_none_or(valid_state::is_unit))
    }
}

impl World {
    /// Returns the whole state as bytes, without the scene and the constants. They begin with their
    /// kind and version, their length and a checksum.
    pub fn snapshot(&self) -> Vec<u8> {
        seal(KIND, &self.state())
    }

    /// Returns the whole state as bytes, without an envelope.
    fn state(&self) -> Vec<u8> {
        let mut whole = Cluster::new(&self.params, self.scene.form);
        for body in 0..self.len() as u32 {
            let (cluster, i) = self.clusters.get(body);
            whole.push(cluster, i);
        }
        for cluster in &self.clusters.list {
            whole.adopt(&cluster.contacts, |i| Some(cluster.ids[i as usize]));
        }
        let state = State {
            time: self.time,
            bodies: whole.bodies,
            contacts: whole.contacts,
            clusters: self.clusters.list.iter().map(|c| (c.ids.clone(), c.contacts.outgrown)).collect(),
            hand_target: self.hand_target,
            forces: self.forces.clone(),
            gravity: self.gravity,
        };
        let mut bytes = postcard::to_stdvec(&state).expect("plain numbers can always be written");
        // Rigid blocks have no particles.
        if self.scene.form == Form::Lattice {
            bytes.extend(postcard::to_stdvec(&whole.particles).expect("plain numbers can always be written"));
        }
        bytes
    }

    /// Restores a state of a world of the same scene and constants, which continues bit for bit.
    ///
    /// # Errors
    /// When the bytes are no snapshot of this version, or one of other bodies, or anything in them
    /// has changed; the world is then unchanged.
    pub fn restore(&mut self, bytes: &[u8]) -> Result<(), SnapshotError> {
        let content = open(KIND, bytes).map_err(|error| match error {
            EnvelopeError::Kind => SnapshotError::Header,
            EnvelopeError::Damaged => SnapshotError::Damaged,
        })?;
        let (state, rest): (State, _) = postcard::take_from_bytes(content).map_err(|_| SnapshotError::Damaged)?;
        let n = self.len();
        if state.bodies.len() != n {
            return Err(SnapshotError::BodyCount { found: state.bodies.len(), expected: n });
        }
        // Particles follow the state of lattice blocks.
        let found = if rest.is_empty() { Form::Rigid } else { Form::Lattice };
        if found != self.scene.form {
            return Err(SnapshotError::Form { found });
        }
        let particles: Vec<Particles> = match found {
            Form::Rigid => Vec::new(),
            Form::Lattice => match postcard::take_from_bytes(rest) {
                Ok((particles, [])) => particles,
                _ => return Err(SnapshotError::Damaged),
            },
        };
        let mut whole = Cluster::new(&self.params, self.scene.form);
        for body in 0..n as u32 {
            let (cluster, i) = self.clusters.get(body);
            whole.ids.push(body);
            whole.shapes.push(&cluster.shapes, i);
        }
        let fixed: Vec<bool> = self.scene.blocks.iter().map(|block| block.fixed).collect();
        let complete = found == Form::Rigid || particles.len() == n;
        if !complete || !numbers_within(&particles, MAX_NUMBER) || !state.is_valid(&whole, &fixed) {
            return Err(SnapshotError::Damaged);
        }
        whole.bodies = state.bodies;
        whole.bodies.stretch =
            particles.iter().zip(&whole.shapes.particles).map(|(p, &half)| p.stretch(half)).collect();
        whole.particles = particles;
        whole.contacts = state.contacts;
        let (parts, outgrown): (Vec<_>, Vec<_>) = state.clusters.into_iter().unzip();
        self.clusters = Clusters::single(whole);
        self.clusters.split(&self.params, self.scene.form, &parts);
        for (cluster, outgrown) in self.clusters.list.iter_mut().zip(outgrown) {
            cluster.contacts.outgrown = outgrown;
        }
        (self.time, self.hand_target) = (state.time, state.hand_target);
        (self.forces, self.gravity) = (state.forces, state.gravity);
        self.write_poses();
        Ok(())
    }

    /// Returns the hash of the whole state (XXH3, 64 bits): equal states have equal hashes on every
    /// target.
    pub fn hash(&self) -> u64 {
        xxhash_rust::xxh3::xxh3_64(&[HASH_VERSION, &self.state()].concat())
    }
}
