//! Set of the bodies to sync.

/// Bodies to sync and repack before the next batch.
#[derive(Debug, Clone, Default)]
pub struct SyncSet {
    /// True if the set holds all bodies; then all contacts are repacked in a new order.
    pub all: bool,
    /// Flag for each body whose contacts are measured and repacked.
    pub members: Vec<bool>,
    /// Bodies in contact with members: their poses are synced too, their other contacts stay
    /// packed.
    pub adjacent: Vec<u32>,
}

impl SyncSet {
    /// Set of all of `n` bodies.
    pub fn all(n: usize) -> Self {
        Self { all: true, members: vec![true; n], adjacent: Vec::new() }
    }

    /// Set of the flagged bodies; of all bodies if more than half are flagged.
    pub fn new(members: Vec<bool>) -> Self {
        let count = members.iter().filter(|&&member| member).count();
        if 2 * count > members.len() {
            Self::all(members.len())
        } else {
            Self { all: false, members, adjacent: Vec::new() }
        }
    }

    /// Indices of the members, in ascending order.
    pub fn iter(&self) -> impl Iterator<Item = usize> {
        self.members.iter().enumerate().filter(|&(_, &member)| member).map(|(i, _)| i)
    }

    /// Returns true if a body of the pair is a member; the floor never is.
    pub fn touches(&self, a: u32, b: u32) -> bool {
        self.contains(a) || self.contains(b)
    }

    fn contains(&self, i: u32) -> bool {
        self.members.get(i as usize).is_some_and(|&member| member)
    }

    /// Adds a body in contact with a member, unless it is the floor or already in the set.
    pub fn add_adjacent(&mut self, i: u32) {
        if i as usize >= self.members.len() || self.contains(i) || self.adjacent.contains(&i) {
            return;
        }
        self.adjacent.push(i);
    }
}
