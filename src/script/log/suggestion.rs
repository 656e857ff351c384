//! Names that are nearly the wanted one.

/// Edits by which a suggested name differs at most.
const FARTHEST: usize = 3;

/// Of pairs of a name and what stands for it, that whose name is nearest to `wanted`; None where all names are far from it.
pub(crate) fn nearest(wanted: &str, names: impl Iterator<Item = (String, String)>) -> Option<String> {
    let most = FARTHEST.min(wanted.chars().count() / 2);
    let near =
        names.map(|(name, shown)| (edit_distance(wanted, &name), name, shown)).filter(|(edits, ..)| *edits <= most);
    near.min_by_key(|(edits, name, _)| (*edits, letter_distance(wanted, name))).map(|(_, _, shown)| shown)
}

/// Of names with as many edits, `joint6` is nearer to `joint7` than `joint1` is, and `joint` is farther: length, then letters.
fn letter_distance(a: &str, b: &str) -> (usize, u32) {
    let letters = a.chars().zip(b.chars()).map(|(a, b)| u32::from(a).abs_diff(u32::from(b)));
    (a.len().abs_diff(b.len()), letters.sum())
}

/// Edit distance (Levenshtein).
pub(crate) fn edit_distance(a: &str, b: &str) -> usize {
    let b: Vec<char> = b.chars().collect();
    let mut row: Vec<usize> = (0..=b.len()).collect();
    for (i, letter) in a.chars().enumerate() {
        let mut diagonal = row[0];
        row[0] = i + 1;
        for (j, other) in b.iter().enumerate() {
            let replaced = diagonal + usize::from(letter != *other);
            diagonal = row[j + 1];
            row[j + 1] = replaced.min(row[j] + 1).min(diagonal + 1);
        }
    }
    row[b.len()]
}

#[cfg(test)]
mod tests {
    use super::{edit_distance, nearest};

    #[test]
    fn counts_edits() {
        assert_eq!(edit_distance("getobject", "getobject"), 0);
        assert_eq!(edit_distance("getobjet", "getobject"), 1);
        assert_eq!(edit_distance("", "abc"), 3);
        assert_eq!(edit_distance("kitten", "sitting"), 3);
    }

    #[test]
    fn the_nearest_name_and_none_that_is_far() {
        let near = |wanted: &str| {
            let names = ["Arm/joint1", "Arm/joint6", "Arm/joint", "Floor"].into_iter();
            nearest(wanted, names.map(|name| (name.to_owned(), format!("/{name}"))))
        };
        assert_eq!(near("Arm/joint7").as_deref(), Some("/Arm/joint6"));
        assert_eq!(near("arm/joint1").as_deref(), Some("/Arm/joint1"));
        assert_eq!(near("Table"), None);
        assert_eq!(near("a"), None);
    }
}
