//! The whole state as bytes, and its hash.

use glam::DVec3;
use serde::{Deserialize, Serialize};
use teeter_scene::Form;

use crate::body::Bodies;
use crate::cluster::Cluster;
use crate::contacts::Contacts;
use crate::hand::Aim;
use crate::input::AppliedForce;
use crate::lattice::Particles;
use crate::regroup::Clusters;
use crate::world::World;

/// Why bytes are no snapshot of this world.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("not a snapshot of this world: {0}")]
pub struct SnapshotError(String);

/// First bytes of a snapshot: what it is, and the version of its layout.
const MAGIC: &[u8] = b"teeter\x00\x03";

/// All that changes: with the constants and the inputs it determines all of the future.
#[derive(Debug, Serialize, Deserialize)]
struct State {
    time: f64,
    bodies: Bodies,
    contacts: Contacts,
    /// The bodies of each cluster, and whether one has outgrown what it was expected to sweep.
    clusters: Vec<(Vec<u32>, bool)>,
    aim: Option<Aim>,
    forces: Vec<AppliedForce>,
    gravity: DVec3,
}

impl State {
    /// Whether it is one of `n` bodies, with nothing missing or out of range.
    fn is_of(&self, n: usize) -> bool {
        let mut ids: Vec<u32> = self.clusters.iter().flat_map(|(ids, _)| ids.iter().copied()).collect();
        ids.sort_unstable();
        let known = |i: u32| i == crate::body::FLOOR || (i as usize) < n;
        self.bodies.is_of(n)
            && self.contacts.bounds.len() == n
            && self.contacts.swept.len() == n
            && self.contacts.manifolds.iter().all(|m| known(m.a) && (m.b as usize) < n)
            && self.clusters.iter().all(|(ids, _)| !ids.is_empty() && ids.is_sorted())
            && ids.into_iter().eq(0..n as u32)
    }
}

impl World {
    /// The whole state as bytes. They hold neither the scene nor the constants.
    pub fn snapshot(&self) -> Vec<u8> {
        let mut whole = Cluster::new(&self.params, self.scene.form);
        for body in 0..self.len() as u32 {
            let (cluster, i) = self.clusters.of(body);
            whole.push(cluster, i);
        }
        for cluster in &self.clusters.list {
            whole.adopt(&cluster.contacts.manifolds, |i| Some(cluster.ids[i as usize]));
        }
        let state = State {
            time: self.time,
            bodies: whole.bodies,
            contacts: whole.contacts,
            clusters: self.clusters.list.iter().map(|c| (c.ids.clone(), c.outgrown)).collect(),
            aim: self.aim,
            forces: self.forces.clone(),
            gravity: self.gravity,
        };
        let mut bytes = MAGIC.to_vec();
        bytes.extend(postcard::to_stdvec(&state).expect("plain numbers can always be written"));
        // a world of rigid blocks ends here
        if self.scene.form == Form::Lattice {
            bytes.extend(postcard::to_stdvec(&whole.particles).expect("plain numbers can always be written"));
        }
        bytes
    }

    /// Takes back a state of a world of the same scene and constants; it goes on bit for bit as that one did.
    ///
    /// # Errors
    /// When the bytes are no snapshot or one of another number of bodies; the world is then unchanged.
    pub fn restore(&mut self, bytes: &[u8]) -> Result<(), SnapshotError> {
        let body = bytes.strip_prefix(MAGIC).ok_or_else(|| SnapshotError("it does not begin like one".into()))?;
        let (state, rest): (State, _) = postcard::take_from_bytes(body).map_err(|e| SnapshotError(e.to_string()))?;
        let n = self.len();
        if state.bodies.len() != n {
            return Err(SnapshotError(format!("it has {} bodies instead of {n}", state.bodies.len())));
        }
        let particles: Vec<Particles> = match self.scene.form {
            Form::Lattice if rest.is_empty() => return Err(SnapshotError("its blocks are rigid".into())),
            Form::Lattice => postcard::from_bytes(rest).map_err(|e| SnapshotError(e.to_string()))?,
            Form::Rigid if rest.is_empty() => Vec::new(),
            Form::Rigid => return Err(SnapshotError("its blocks have springs".into())),
        };
        if !state.is_of(n) || (self.scene.form == Form::Lattice && particles.len() != n) {
            return Err(SnapshotError("it is damaged".into()));
        }
        let mut whole = Cluster::new(&self.params, self.scene.form);
        for body in 0..n as u32 {
            let (cluster, i) = self.clusters.of(body);
            whole.ids.push(body);
            whole.shapes.push(&cluster.shapes, i);
        }
        whole.bodies = state.bodies;
        whole.bodies.stretch =
            particles.iter().zip(&whole.shapes.particles).map(|(p, &half)| p.stretch(half)).collect();
        whole.particles = particles;
        whole.contacts = state.contacts;
        let (parts, outgrown): (Vec<_>, Vec<_>) = state.clusters.into_iter().unzip();
        self.clusters = Clusters::one(whole);
        self.clusters.split(&self.params, self.scene.form, &parts);
        for (cluster, outgrown) in self.clusters.list.iter_mut().zip(outgrown) {
            cluster.outgrown = outgrown;
        }
        (self.time, self.aim, self.forces, self.gravity) = (state.time, state.aim, state.forces, state.gravity);
        self.write_poses();
        Ok(())
    }

    /// Hash of the whole state (XXH3, 64 bits): equal states have equal hashes on every target.
    pub fn hash(&self) -> u64 {
        xxhash_rust::xxh3::xxh3_64(&self.snapshot())
    }
}
