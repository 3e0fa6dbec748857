//! Names of fields: the nearest known name for one that is not, and the names of other formats.

use crate::printable::shown;

/// Minimum similarity of a misspelt name with a known one, from 0 to 1: `stifness` and `stiffness`
/// have 0.89, `mas` and `mass` 0.75, `colour` and `form` 0.33.
const MIN_SIMILARITY: f64 = 0.6;

/// Names in other formats, in lower case and without separators, and the advice for each.
const FOREIGN: &[(&[&str], &str)] = &[
    (
        &["quat", "quaternion", "rot", "rotation", "q", "xyzw"],
        "write `orientation`, a unit quaternion [x, y, z, w] with w last, or `yaw`",
    ),
    (&["wxyz"], "write `orientation`, a unit quaternion [x, y, z, w] with w last"),
    (
        &["rpy", "euler", "eulerangles", "angle", "angles", "axisangle", "roll", "pitch"],
        "write `yaw` in radians for a rotation about the vertical, `orientation` [x, y, z, w] for any other",
    ),
    (
        &["position", "center", "centre", "translation", "origin", "location", "xyz", "p"],
        "write `pos`, the [x, y, z] of the centre in m",
    ),
    (
        &["halfextents", "halfextent", "halfsize", "halfsizes", "halfedges", "extents", "half"],
        "write `size`, the full edge lengths in m",
    ),
    (
        &["dims", "dim", "dimensions", "dimension", "scale", "length", "width", "height", "depth", "box"],
        "write `size`, the three edge lengths in m",
    ),
    (&["density", "rho"], "write `mass` in kg, the density times the volume"),
    (&["weight", "m"], "write `mass` in kg"),
    (&["mu", "mus", "frictioncoefficient", "staticfriction"], "write `friction`"),
    (&["muk", "dynamicfriction"], "write `kinetic_friction` in the scene"),
    (&["e", "bounce", "bounciness", "cor"], "write `restitution` in the scene"),
    (
        &["angularvelocity", "angvel", "omega", "w", "rotationalvelocity"],
        "write `spin`, the angular velocity [x, y, z] in rad/s",
    ),
    (&["linearvelocity", "linvel", "vel", "v", "speed"], "write `velocity`, the [x, y, z] of the centre's in m/s"),
    (&["static", "isstatic", "kinematic", "iskinematic", "immovable", "anchored"], "write `fixed`: true"),
    (&["dynamic", "isdynamic"], "a block moves unless it is `fixed`"),
    (&["g", "gravityvector"], "write `gravity`, one number: the acceleration downwards in m/s²"),
    (&["bodies", "objects", "boxes", "bricks", "actors", "links"], "write `blocks`"),
    (&["k", "contactstiffness", "kn", "ke"], "write `stiffness` in N/m"),
    (&["radius", "bevel", "rounding", "edgerounding", "fillet"], "write `edge_radius` of the scene in m"),
    (&["title", "scene"], "write `name`"),
    (&["dt", "timestep", "frame", "substeps"], "the time step belongs to the run, not to the scene"),
    (&["description", "note", "notes", "comments", "remark"], "write `comment`"),
];

/// Kind of object with its article, and the names of its fields.
pub type Known = (&'static str, &'static [&'static str]);

/// Message about a field that an object does not have, but perhaps one of the other kinds of
/// object.
pub fn unknown(name: &str, (kind, known): Known, others: &[Known]) -> String {
    let message = format!("`{}` is not a field of {kind}", shown(name));
    let folded = fold(name);
    let is_same = |k: &&&str| fold(k) == folded;
    if let Some(same) = known.iter().find(is_same) {
        return format!("{message}: did you mean `{same}`?");
    }
    if let Some((owner, same)) = others.iter().find_map(|(kind, known)| Some((kind, known.iter().find(is_same)?))) {
        return format!("{message}: `{same}` is one of {owner}");
    }
    let foreign = || FOREIGN.iter().flat_map(|(names, advice)| names.iter().map(move |name| (*name, *advice)));
    if let Some((_, advice)) = foreign().find(|(name, _)| *name == folded) {
        return format!("{message}: {advice}");
    }
    if let Some(nearest) = nearest(&folded, known.iter().map(|k| (fold(k), *k))) {
        return format!("{message}: did you mean `{nearest}`?");
    }
    match nearest(&folded, foreign().map(|(name, advice)| (name.to_owned(), advice))) {
        Some(advice) => format!("{message}: {advice}"),
        None => format!("{message}, which has {}", list(known)),
    }
}

/// Value of the name that is most similar to a folded one, if it is similar enough to be meant.
fn nearest<T: Copy>(folded: &str, names: impl Iterator<Item = (String, T)>) -> Option<T> {
    let similar = names.map(|(name, value)| (strsim::normalized_damerau_levenshtein(folded, &name), value));
    let (similarity, value) = similar.max_by(|a, b| a.0.total_cmp(&b.0))?;
    (similarity >= MIN_SIMILARITY).then_some(value)
}

fn list(names: &[&str]) -> String {
    names.iter().map(|name| format!("`{name}`")).collect::<Vec<_>>().join(", ")
}

/// Name in lower case without separators: `halfExtents` and `half_extents` are one name.
fn fold(name: &str) -> String {
    name.chars().take(100).filter(|c| !matches!(c, '_' | '-' | ' ')).flat_map(char::to_lowercase).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn foreign_names_are_folded_and_unique() {
        let all: Vec<&str> = FOREIGN.iter().flat_map(|(names, _)| *names).copied().collect();
        for name in &all {
            assert_eq!(fold(name), *name);
            assert_eq!(all.iter().filter(|other| *other == name).count(), 1, "{name}");
        }
    }

    #[test]
    fn a_field_of_another_kind_of_object_is_named_with_its_owner() {
        let block: Known = ("a block", &["mass", "friction"]);
        let scene: Known = ("a scene", &["friction", "restitution"]);
        let message = unknown("Restitution", block, &[scene]);
        assert_eq!(message, "`Restitution` is not a field of a block: `restitution` is one of a scene");
    }

    #[test]
    fn a_misspelt_name_gets_the_nearest_one() {
        let known: Known = ("a scene", &["name", "friction", "kinetic_friction", "stiffness", "restitution"]);
        for (name, nearest) in [
            ("stifness", "stiffness"),
            ("kinetic_fricton", "kinetic_friction"),
            ("Friction", "friction"),
            ("KineticFriction", "kinetic_friction"),
            ("restituion", "restitution"),
        ] {
            let message = unknown(name, known, &[]);
            assert_eq!(message, format!("`{name}` is not a field of a scene: did you mean `{nearest}`?"));
        }
        assert_eq!(
            unknown("\u{1b}[31mzebra", (known.0, &["name", "friction"]), &[]),
            "` [31mzebra` is not a field of a scene, which has `name`, `friction`"
        );
    }
}
