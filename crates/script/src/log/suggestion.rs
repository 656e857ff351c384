//! Names that are nearly the wanted one.

use strsim::levenshtein;

/// Most edits by which a suggested name may differ.
const MAX_EDITS: usize = 3;

/// Of pairs of a name and what stands for it, that whose name is nearest to `wanted`; None where all names are far from it.
pub fn nearest(wanted: &str, names: impl Iterator<Item = (String, String)>) -> Option<String> {
    let most = MAX_EDITS.min(wanted.chars().count() / 2);
    let near = names
        .map(|(name, shown)| (levenshtein(wanted, &name), name, shown))
        .filter(|(edits, ..)| *edits <= most);
    near.min_by_key(|(edits, name, _)| (*edits, letter_distance(wanted, name)))
        .map(|(_, _, shown)| shown)
}

/// Of names with as many edits, `joint6` is nearer to `joint7` than `joint1` is, and `joint` is farther: length, then letters.
fn letter_distance(a: &str, b: &str) -> (usize, u32) {
    let letters = a
        .chars()
        .zip(b.chars())
        .map(|(a, b)| u32::from(a).abs_diff(u32::from(b)));
    (a.len().abs_diff(b.len()), letters.sum())
}

#[cfg(test)]
mod tests {
    use super::nearest;

    #[test]
    fn the_nearest_name_and_none_that_is_far() {
        let near = |wanted: &str| {
            let names = ["Arm/joint1", "Arm/joint6", "Arm/joint", "Floor"].into_iter();
            nearest(
                wanted,
                names.map(|name| (name.to_owned(), format!("/{name}"))),
            )
        };
        assert_eq!(near("Arm/joint7").as_deref(), Some("/Arm/joint6"));
        assert_eq!(near("arm/joint1").as_deref(), Some("/Arm/joint1"));
        assert_eq!(near("Table"), None);
        assert_eq!(near("a"), None);
    }
}
