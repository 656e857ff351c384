//! What can be done with a path: measured, divided, shortened.

use crate::{Problem, State, StateSpace};

/// Rounds of shortening at most, each as long as the path has states.
const ROUNDS: usize = 20;
/// Shortcuts without success after which a round ends.
const FAILURES: usize = 20;

/// The length of a path.
pub fn length(space: &dyn StateSpace, states: &[State]) -> f64 {
    states
        .windows(2)
        .map(|pair| space.distance(&pair[0], &pair[1]))
        .sum()
}

/// Adds states so that no piece is longer than the resolution of the checks.
pub fn densify(space: &dyn StateSpace, states: &[State], resolution: f64) -> Vec<State> {
    divide(space, states, |from, to| space.parts(from, to, resolution))
}

/// Adds states so that there are `count`, in proportion to the lengths of the pieces. The path is as before where it has as many already.
pub fn interpolate(space: &dyn StateSpace, states: &[State], count: usize) -> Vec<State> {
    if states.len() < 2 || count <= states.len() {
        return states.to_vec();
    }
    let mut left = length(space, states);
    let mut missing = count - states.len();
    let mut pieces = states.len() - 1;
    divide(space, states, |from, to| {
        let piece = space.distance(from, to);
        pieces -= 1;
        let share = if left > 0.0 {
            (missing as f64 * piece / left).round() as usize
        } else {
            0
        };
        let added = if pieces == 0 {
            missing
        } else {
            share.min(missing)
        };
        (left, missing) = (left - piece, missing - added);
        added + 1
    })
}

fn divide(
    space: &dyn StateSpace,
    states: &[State],
    mut parts: impl FnMut(&[f64], &[f64]) -> usize,
) -> Vec<State> {
    let Some(first) = states.first() else {
        return Vec::new();
    };
    let mut out = vec![first.clone()];
    for pair in states.windows(2) {
        let parts = parts(&pair[0], &pair[1]);
        out.extend(
            (1..parts)
                .map(|part| space.interpolate(&pair[0], &pair[1], part as f64 / parts as f64)),
        );
        out.push(pair[1].clone());
    }
    out
}

/// Shortens a path: leaves out states, cuts corners at random places, and rounds them. The ends stay, and what it returns is valid if the path
/// was. It ends when nothing helps any more, after so many rounds, or when the world has enough.
pub fn simplify(problem: &mut Problem<'_>, states: &mut Vec<State>) {
    for _ in 0..ROUNDS {
        let before = length(problem.space, states);
        reduce(problem, states);
        shortcut(problem, states);
        if problem.space.is_symmetric() {
            smooth(problem, states);
        }
        let after = length(problem.space, states);
        if problem.world.is_over() || after >= before * (1.0 - 1e-3) {
            break;
        }
    }
    reduce(problem, states);
}

/// Leaves out states between two that can be joined directly.
pub fn reduce(problem: &mut Problem<'_>, states: &mut Vec<State>) {
    let mut first = 0;
    while first + 2 < states.len() && !problem.world.is_over() {
        let candidates = (first + 2..states.len()).rev();
        let joined = candidates.into_iter().find(|&last| {
            let (from, to) = (&states[first], &states[last]);
            let around = length(problem.space, &states[first..=last]);
            problem.space.distance(from, to) <= around + 1e-12 && problem.is_motion_valid(from, to)
        });
        if let Some(last) = joined {
            states.drain(first + 1..last);
        }
        first += 1;
    }
}

/// Joins random places of the path directly where that is shorter.
pub fn shortcut(problem: &mut Problem<'_>, states: &mut Vec<State>) {
    let mut failures = 0;
    while failures < FAILURES && states.len() > 2 && !problem.world.is_over() {
        let total = length(problem.space, states);
        let mut places = [
            problem.random.between(0.0, total),
            problem.random.between(0.0, total),
        ];
        places.sort_by(f64::total_cmp);
        failures = if join(problem, states, places) {
            0
        } else {
            failures + 1
        };
    }
}

/// The state at a length along the path, and the place of the state before it.
fn at_length(space: &dyn StateSpace, states: &[State], mut place: f64) -> (usize, State) {
    for (before, pair) in states.windows(2).enumerate() {
        let piece = space.distance(&pair[0], &pair[1]);
        if place <= piece && piece > 0.0 {
            return (before, space.interpolate(&pair[0], &pair[1], place / piece));
        }
        place -= piece;
    }
    let last = states.len() - 1;
    (last.saturating_sub(1), states[last].clone())
}

fn join(problem: &mut Problem<'_>, states: &mut Vec<State>, places: [f64; 2]) -> bool {
    let [(first, from), (last, to)] = places.map(|place| at_length(problem.space, states, place));
    if first == last {
        return false;
    }
    let mut detour = vec![from.clone()];
    detour.extend_from_slice(&states[first + 1..=last]);
    detour.push(to.clone());
    let around = length(problem.space, &detour);
    if problem.space.distance(&from, &to) > 0.999 * around || !problem.is_motion_valid(&from, &to) {
        return false;
    }
    // What is left of the pieces is checked at other places than the whole was.
    if !problem.is_motion_valid(&states[first].clone(), &from)
        || !problem.is_motion_valid(&to, &states[last + 1].clone())
    {
        return false;
    }
    states.splice(first + 1..=last, [from, to]);
    true
}

/// Rounds corners: each state moves to the middle of its neighbours' middles (a step of subdivision to a B-spline), where that is valid.
pub fn smooth(problem: &mut Problem<'_>, states: &mut [State]) {
    for place in 1..states.len().saturating_sub(1) {
        let (before, here, after) = (&states[place - 1], &states[place], &states[place + 1]);
        let first = problem.space.interpolate(before, here, 0.75);
        let second = problem.space.interpolate(here, after, 0.25);
        let middle = problem.space.interpolate(&first, &second, 0.5);
        let (before, after) = (before.clone(), after.clone());
        if problem.is_motion_valid(&before, &middle) && problem.is_motion_valid(&middle, &after) {
            states[place] = middle;
        }
    }
}
