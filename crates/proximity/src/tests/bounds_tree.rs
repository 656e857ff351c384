//! The index against a plain list.

use std::collections::BTreeMap;

use super::random::Random;
use crate::{Bounds, BoundsTree};

fn random_box(random: &mut Random) -> Bounds {
    let [a, b] = [random.point(10.0), random.point(0.5)];
    Bounds {
        min: [0, 1, 2].map(|i| a[i] - b[i].abs()),
        max: [0, 1, 2].map(|i| a[i] + b[i].abs()),
    }
}

/// A tree after random insertions, moves and removals, and what should be in it.
fn changed(random: &mut Random) -> (BoundsTree, BTreeMap<u32, Bounds>) {
    let (mut tree, mut list) = (BoundsTree::default(), BTreeMap::new());
    for _ in 0..600 {
        let key = random.below(200);
        if random.below(3) == 0 {
            assert_eq!(tree.remove(key), list.remove(&key).is_some());
        } else {
            let bounds = random_box(random);
            tree.insert(key, &bounds);
            list.insert(key, bounds);
        }
    }
    (tree, list)
}

#[test]
fn finds_what_a_list_finds() {
    let mut random = Random::new(1);
    for _ in 0..20 {
        let (tree, list) = changed(&mut random);
        assert_eq!(tree.len(), list.len());
        assert_eq!(
            tree.bounds(),
            list.values()
                .fold(Bounds::EMPTY, |all, bounds| all.merged(bounds))
        );
        let wanted = random_box(&mut random).grown(2.0);
        let mut found = Vec::new();
        tree.overlapping(&wanted, |key| found.push(key));
        found.sort_unstable();
        let expected: Vec<u32> = list
            .iter()
            .filter(|(_, b)| b.overlaps(&wanted))
            .map(|(key, _)| *key)
            .collect();
        assert_eq!(found, expected);
        list.iter()
            .for_each(|(key, bounds)| assert_eq!(tree.bounds_of(*key), Some(*bounds)));
    }
}

#[test]
fn visits_by_ascending_distance_until_the_limit() {
    let mut random = Random::new(2);
    for _ in 0..20 {
        let (tree, list) = changed(&mut random);
        let from = random.point(10.0);
        let mut found = Vec::new();
        tree.nearest_first(
            |b| b.distance_to_point(&from),
            5.0,
            |key, bound, limit| {
                found.push((bound, key));
                limit
            },
        );
        let mut expected: Vec<(f64, u32)> = list
            .iter()
            .map(|(key, b)| (b.distance_to_point(&from), *key))
            .collect();
        expected.retain(|(bound, _)| *bound < 5.0);
        expected.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        assert_eq!(found, expected);
        let mut first = Vec::new();
        tree.nearest_first(
            |b| b.distance_to_point(&from),
            5.0,
            |key, bound, _| {
                first.push(key);
                bound
            },
        );
        assert_eq!(
            first,
            expected
                .iter()
                .take(1)
                .map(|(_, key)| *key)
                .collect::<Vec<_>>()
        );
    }
}

#[test]
fn equal_boxes_make_a_shallow_tree() {
    let mut tree = BoundsTree::default();
    let bounds = Bounds {
        min: [0.0; 3],
        max: [1.0; 3],
    };
    (0..20_000).for_each(|key| tree.insert(key, &bounds));
    let mut number = 0;
    tree.along_ray([0.5, 0.5, -1.0], [0.0, 0.0, 1.0], [0.0, 2.0], |_, limit| {
        number += 1;
        limit
    });
    assert_eq!(number, 20_000);
    (0..20_000).for_each(|key| assert!(tree.remove(key)));
    assert!(tree.is_empty() && tree.bounds().is_empty());
}

#[test]
fn what_is_not_a_number_is_not_stored() {
    let mut tree = BoundsTree::default();
    tree.insert(
        1,
        &Bounds {
            min: [0.0; 3],
            max: [1.0; 3],
        },
    );
    tree.insert(
        1,
        &Bounds {
            min: [f64::NAN; 3],
            max: [1.0; 3],
        },
    );
    assert!(tree.is_empty());
    tree.insert(
        2,
        &Bounds {
            min: [0.0; 3],
            max: [1.0; 3],
        },
    );
    tree.along_ray([f64::NAN; 3], [1.0, 0.0, 0.0], [0.0, 1.0], |_, _| {
        panic!("no ray")
    });
    tree.along_ray([0.5; 3], [0.0; 3], [0.0, 1.0], |_, _| {
        panic!("no direction")
    });
    tree.nearest_first(|_| f64::NAN, 1.0, |_, _, _| panic!("no bound"));
}
