//! Line-by-line comparison of texts, in the unified format.

/// Equal lines around a difference.
const AROUND: usize = 3;
/// Beyond this many pairs of lines, everything between the first and the last difference is one change.
const MAX_PAIRS: usize = 16_000_000;

#[derive(Clone, Copy, PartialEq)]
enum Mark {
    Same,
    Removed,
    Added,
}

/// The differences of two texts; empty when they are the same.
pub(super) fn unified(a: &str, b: &str) -> String {
    let (a, b): (Vec<&str>, Vec<&str>) = (a.lines().collect(), b.lines().collect());
    let script = script(&a, &b);
    let mut out = String::new();
    let mut from = 0;
    while let Some(first) = script[from..]
        .iter()
        .position(|(mark, ..)| *mark != Mark::Same)
        .map(|at| at + from)
    {
        let start = first.saturating_sub(AROUND).max(from);
        let end = end_of_hunk(&script, first);
        out += &hunk(&script[start..end]);
        from = end;
    }
    out
}

/// A mark, a line, and how many lines of both texts came before.
type Step<'a> = (Mark, &'a str, usize, usize);

fn end_of_hunk(script: &[Step<'_>], first: usize) -> usize {
    let mut end = first;
    for (at, (mark, ..)) in script.iter().enumerate().skip(first) {
        if *mark != Mark::Same {
            end = at + 1;
        } else if at - end >= 2 * AROUND {
            break;
        }
    }
    (end + AROUND).min(script.len())
}

fn hunk(steps: &[Step<'_>]) -> String {
    let count = |other: Mark| steps.iter().filter(|(mark, ..)| *mark != other).count();
    let (_, _, a, b) = steps[0];
    let mut out = format!(
        "@@ -{},{} +{},{} @@\n",
        a + 1,
        count(Mark::Added),
        b + 1,
        count(Mark::Removed)
    );
    for (mark, line, ..) in steps {
        let sign = match mark {
            Mark::Same => ' ',
            Mark::Removed => '-',
            Mark::Added => '+',
        };
        out += &format!("{sign}{line}\n");
    }
    out
}

/// How to make one text the other.
fn script<'a>(a: &[&'a str], b: &[&'a str]) -> Vec<Step<'a>> {
    let head = a.iter().zip(b).take_while(|(x, y)| x == y).count();
    let (a_rest, b_rest) = (&a[head..], &b[head..]);
    let tail = a_rest
        .iter()
        .rev()
        .zip(b_rest.iter().rev())
        .take_while(|(x, y)| x == y)
        .count();
    let (a_mid, b_mid) = (
        &a_rest[..a_rest.len() - tail],
        &b_rest[..b_rest.len() - tail],
    );
    let mut marks = vec![Mark::Same; head];
    marks.extend(middle(a_mid, b_mid));
    marks.extend(vec![Mark::Same; tail]);
    let (mut i, mut j) = (0, 0);
    let step = |mark: Mark| {
        let step = (mark, if mark == Mark::Added { b[j] } else { a[i] }, i, j);
        (i, j) = (
            i + usize::from(mark != Mark::Added),
            j + usize::from(mark != Mark::Removed),
        );
        step
    };
    marks.into_iter().map(step).collect()
}

/// By the longest common subsequence.
fn middle(a: &[&str], b: &[&str]) -> Vec<Mark> {
    let whole = || [vec![Mark::Removed; a.len()], vec![Mark::Added; b.len()]].concat();
    if a.is_empty() || b.is_empty() || a.len().saturating_mul(b.len()) > MAX_PAIRS {
        return whole();
    }
    let width = b.len() + 1;
    let mut common = vec![0u32; (a.len() + 1) * width];
    for i in (0..a.len()).rev() {
        for j in (0..b.len()).rev() {
            common[i * width + j] = if a[i] == b[j] {
                common[(i + 1) * width + j + 1] + 1
            } else {
                common[(i + 1) * width + j].max(common[i * width + j + 1])
            };
        }
    }
    let (mut i, mut j, mut marks) = (0, 0, Vec::new());
    while i < a.len() || j < b.len() {
        let removal = j == b.len()
            || (i < a.len() && common[(i + 1) * width + j] >= common[i * width + j + 1]);
        if i < a.len() && j < b.len() && a[i] == b[j] {
            marks.push(Mark::Same);
            (i, j) = (i + 1, j + 1);
        } else if removal {
            marks.push(Mark::Removed);
            i += 1;
        } else {
            marks.push(Mark::Added);
            j += 1;
        }
    }
    marks
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn differences_are_shown_with_their_context() {
        assert_eq!(unified("a\nb\n", "a\nb"), "");
        assert_eq!(
            unified("a\nb\nc", "a\nx\nc"),
            "@@ -1,3 +1,3 @@\n a\n-b\n+x\n c\n"
        );
        assert_eq!(unified("", "a"), "@@ -1,0 +1,1 @@\n+a\n");
        let far: String = (0..30).map(|i| format!("{i}\n")).collect();
        let changed = far.replace("\n2\n", "\ntwo\n").replace("\n25\n", "\n");
        assert_eq!(unified(&far, &changed).matches("@@ -").count(), 2);
        assert!(unified(&far, &changed).contains("@@ -23,7 +23,6 @@"));
    }
}
