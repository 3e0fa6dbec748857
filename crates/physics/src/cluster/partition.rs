//! Partition of the bodies into clusters.
//!
//! Each body has swept bounds, which it does not leave within a frame. Bodies whose swept bounds
//! overlap share a cluster, and clusters are stepped independently for a whole frame. Swept bounds
//! are generous and persist until a body needs more, or much less, so that a tower at rest needs no
//! update. They are part of the state, because the clusters follow from them.

use teeter_scene::Form;

use crate::body_id::BodyId;
use crate::cluster::Cluster;
use crate::cluster::island::islands;
use crate::collision::broad_phase::{Aabb, overlapping_pairs};
use crate::constants::{MIN_SWEEP, SWEEP_EXCESS, SWEEP_FACTOR, SWEEP_SLACK};
use crate::params::Params;

/// Clusters of a world, in the order of their first bodies.
#[derive(Debug, Clone, Default)]
pub struct Clusters {
    pub list: Vec<Cluster>,
    /// Cluster of each body of the world, and the body's index there.
    pub locations: Vec<(u32, u32)>,
}

/// Bodies of several clusters, divided into connected parts.
struct Parts {
    /// Indices in the world of the bodies of each part, in ascending order.
    members: Vec<Vec<u32>>,
    /// Pairs of overlapping swept bounds of each part, by index in the part.
    pairs: Vec<Vec<(u32, u32)>>,
}

impl Parts {
    /// Connected parts of the bodies `ids` by their swept bounds.
    fn new(ids: &[u32], swept: &[Aabb]) -> Self {
        let overlaps = overlapping_pairs(swept);
        let root = islands(ids.len(), overlaps.iter().copied());
        let mut members: Vec<Vec<u32>> = Vec::new();
        let mut part_of = vec![0; ids.len()];
        let mut index_of = vec![0; ids.len()];
        for (i, &r) in root.iter().enumerate() {
            if r as usize == i {
                part_of[i] = members.len();
                members.push(Vec::new());
            } else {
                part_of[i] = part_of[r as usize];
            }
            index_of[i] = members[part_of[i]].len() as u32;
            members[part_of[i]].push(ids[i]);
        }
        let mut pairs: Vec<Vec<(u32, u32)>> = vec![Vec::new(); members.len()];
        for &(a, b) in &overlaps {
            pairs[part_of[a as usize]].push((index_of[a as usize], index_of[b as usize]));
        }
        Self { members, pairs }
    }
}

impl Clusters {
    /// All bodies in a single cluster.
    pub fn single(cluster: Cluster) -> Self {
        let locations = (0..cluster.len() as u32).map(|i| (0, i)).collect();
        Self { list: vec![cluster], locations }
    }

    /// Cluster of a body, and the body's index there.
    pub fn get(&self, body: u32) -> (&Cluster, usize) {
        let (cluster, i) = self.locations[body as usize];
        (&self.list[cluster as usize], i as usize)
    }

    /// Mutable cluster of a body, and the body's index there.
    pub fn get_mut(&mut self, body: u32) -> (&mut Cluster, usize) {
        let (cluster, i) = self.locations[body as usize];
        (&mut self.list[cluster as usize], i as usize)
    }

    /// Updates the partition for a frame of `frame` (s) in which the input may move bodies at
    /// `input_speeds` (m/s).
    pub fn partition(&mut self, params: &Params, form: Form, frame: f64, input_speeds: &[(BodyId, f64)]) {
        // Merged clusters sweep at the speed of the fastest, so the update repeats until nothing
        // changes.
        loop {
            let mut fastest = vec![0.0; self.list.len()];
            for &(body, speed) in input_speeds {
                let fastest: &mut f64 = &mut fastest[self.locations[body.index()].0 as usize];
                *fastest = fastest.max(speed);
            }
            let mut changed: Vec<bool> = Vec::new();
            for (cluster, input_speed) in self.list.iter_mut().zip(fastest) {
                changed.push(update_swept(cluster, frame, input_speed));
            }
            if !changed.contains(&true) || !self.divide(params, form, &changed) {
                return;
            }
        }
    }

    /// Divides the changed clusters, and those within their reach, into connected parts. Returns
    /// true if the clusters differ from before.
    fn divide(&mut self, params: &Params, form: Form, changed: &[bool]) -> bool {
        let involved = self.in_reach(changed);
        let mut ids: Vec<u32> = involved.iter().flat_map(|&c| self.list[c].ids.iter().copied()).collect();
        ids.sort_unstable();
        let swept: Vec<Aabb> =
            ids.iter().map(|&id| self.get(id)).map(|(cluster, i)| cluster.contacts.swept[i]).collect();
        let Parts { members, pairs } = Parts::new(&ids, &swept);

        let same = members.len() == involved.len() && members.iter().all(|part| self.get(part[0]).0.ids == *part);
        if !same {
            self.rebuild(params, form, &involved, &members);
        }
        for (part, pairs) in members.iter().zip(&pairs) {
            self.get_mut(part[0]).0.contacts.set_neighbours(pairs);
        }
        if !same {
            self.detect_new_pairs(&members);
        }
        !same
    }

    /// Clusters that have changed, or whose hull overlaps that of one that has.
    ///
    /// Hulls are computed here and never stored: swept bounds grow in several steps, and a snapshot
    /// holds the bounds alone.
    fn in_reach(&self, changed: &[bool]) -> Vec<usize> {
        let mut involved = changed.to_vec();
        if changed.contains(&false) {
            let hull = |cluster: &Cluster| cluster.contacts.swept.iter().fold(Aabb::default(), |a, b| a.union(b));
            let hulls: Vec<Aabb> = self.list.iter().map(hull).collect();
            for (a, b) in overlapping_pairs(&hulls) {
                let (a, b) = (a as usize, b as usize);
                involved[a] |= changed[b];
                involved[b] |= changed[a];
            }
        }
        (0..involved.len()).filter(|&c| involved[c]).collect()
    }

    /// Divides a single cluster into parts of the given members.
    pub fn split(&mut self, params: &Params, form: Form, parts: &[Vec<u32>]) {
        self.rebuild(params, form, &[0], parts);
        self.list.iter_mut().for_each(|cluster| cluster.contacts.update_neighbours());
    }

    /// Replaces the clusters `involved` (sorted) by clusters of the given members.
    fn rebuild(&mut self, params: &Params, form: Form, involved: &[usize], parts: &[Vec<u32>]) {
        let mut next: Vec<Cluster> = Vec::new();
        for part in parts {
            let mut cluster = Cluster::new(params, form);
            let mut sources: Vec<u32> = Vec::new();
            for &id in part {
                let (source, i) = self.locations[id as usize];
                cluster.push(&self.list[source as usize], i as usize);
                if !sources.contains(&source) {
                    sources.push(source);
                }
            }
            for source in sources {
                let source = &self.list[source as usize];
                let index = |i: u32| part.binary_search(&source.ids[i as usize]).ok().map(|i| i as u32);
                cluster.adopt(&source.contacts, index);
            }
            next.push(cluster);
        }
        let mut c = 0;
        self.list.retain(|_| {
            c += 1;
            involved.binary_search(&(c - 1)).is_err()
        });
        self.list.extend(next);
        self.list.sort_by_key(|cluster| cluster.ids[0]);
        for (c, cluster) in self.list.iter().enumerate() {
            for (i, &id) in cluster.ids.iter().enumerate() {
                self.locations[id as usize] = (c as u32, i as u32);
            }
        }
    }

    /// Detects contacts of bodies that have come near each other in different clusters, because one
    /// left its swept bounds.
    fn detect_new_pairs(&mut self, parts: &[Vec<u32>]) {
        for part in parts {
            let (cluster, _) = self.get_mut(part[0]);
            let contacts = &mut cluster.contacts;
            let is_new = |&(a, b): &(u32, u32)| contacts.find((a, b)).is_none();
            let mut due: Vec<u32> =
                overlapping_pairs(&contacts.bounds).into_iter().filter(is_new).flat_map(|(a, b)| [a, b]).collect();
            due.sort_unstable();
            due.dedup();
            let pairs = contacts.candidate_pairs(&cluster.shapes, &mut cluster.bodies, &due, MIN_SWEEP);
            contacts.detect(&cluster.shapes, &cluster.bodies, &due, &pairs);
        }
    }
}

/// Updates the swept bounds of a cluster whose bodies the input may move at `input_speed` (m/s).
/// Returns true if any has changed since the last update. Those of bodies that nothing moves stay,
/// but may have grown in the frame in which the last of them was quarantined or fell asleep.
fn update_swept(cluster: &mut Cluster, frame: f64, input_speed: f64) -> bool {
    let mut changed = std::mem::take(&mut cluster.contacts.outgrown);
    if !cluster.is_awake() {
        return changed;
    }
    let reach = MIN_SWEEP + SWEEP_FACTOR * frame * cluster.max_speed().max(input_speed);
    for i in 0..cluster.len() {
        let needed = Aabb::new(&cluster.shapes, &cluster.bodies, i, reach).union(&cluster.contacts.bounds[i]);
        let swept = &mut cluster.contacts.swept[i];
        if !swept.contains(&needed) || !needed.grown(SWEEP_EXCESS).contains(swept) {
            *swept = needed.grown(SWEEP_SLACK);
            changed = true;
        }
    }
    changed
}
