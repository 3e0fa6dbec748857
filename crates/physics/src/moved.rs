//! Which bodies are to be synced, packed and loaded anew.

/// A choice of bodies.
#[derive(Debug, Clone, Default)]
pub struct Moved {
    /// Whether it is all of them: then everything is laid out anew.
    pub all: bool,
    /// The bodies whose contacts are measured and packed anew.
    pub is: Vec<bool>,
    /// Others that touch them: their poses are made exact too, their other contacts stay as they are.
    pub beside: Vec<u32>,
}

impl Moved {
    /// All of `n` bodies.
    pub fn all(n: usize) -> Self {
        Self { all: true, is: vec![true; n], beside: Vec::new() }
    }

    /// The bodies for which `is` holds; where that is most of them, all.
    pub fn those(is: Vec<bool>) -> Self {
        let count = is.iter().filter(|&&is| is).count();
        if 2 * count > is.len() { Self::all(is.len()) } else { Self { all: false, is, beside: Vec::new() } }
    }

    /// The bodies chosen, in order.
    pub fn list(&self) -> impl Iterator<Item = usize> {
        self.is.iter().enumerate().filter(|&(_, &is)| is).map(|(i, _)| i)
    }

    /// Whether a contact has one of them; the floor is none.
    pub fn touches(&self, a: u32, b: u32) -> bool {
        self.has(a) || self.has(b)
    }

    fn has(&self, i: u32) -> bool {
        self.is.get(i as usize).is_some_and(|&is| is)
    }

    /// Adds a body beside them.
    pub fn add_beside(&mut self, i: u32) {
        if i as usize >= self.is.len() || self.has(i) || self.beside.contains(&i) {
            return;
        }
        self.beside.push(i);
    }
}
