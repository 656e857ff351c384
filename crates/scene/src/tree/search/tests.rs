//! What paths lead to, compared with a search of everything, and how many objects are visited for it.

use super::*;
use crate::Kind;
use crate::object::dummy::Dummy;
use test_support::random::Random;

#[test]
fn wildcards() {
    for (pattern, text) in [
        ("a*", "a"),
        ("*", ""),
        ("a?c", "abc"),
        ("*b*d", "abcd"),
        ("a*b", "aabab"),
    ] {
        assert!(
            wildcard_match(pattern.as_bytes(), text.as_bytes()),
            "{pattern} {text}"
        );
    }
    for (pattern, text) in [("a?", "a"), ("?", ""), ("a", "ab"), ("*c", "ab")] {
        assert!(
            !wildcard_match(pattern.as_bytes(), text.as_bytes()),
            "{pattern} {text}"
        );
    }
}

/// Small trees of objects of few names, which change.
struct Trees {
    scene: Scene,
    random: Random,
}

impl Trees {
    fn alias(&mut self) -> &'static str {
        ["a", "b", "ab", "ba"][self.random.below(4)]
    }

    fn any(&mut self) -> Handle {
        let all = self.scene.all_breadth_first();
        all[self.random.below(all.len())]
    }

    fn add(&mut self) {
        let (alias, parent) = (self.alias(), (self.scene.len() > 1).then(|| self.any()));
        let dummy = Kind::Dummy(Dummy::new(0.01));
        let new = self.scene.add(alias, dummy).unwrap();
        self.scene.set_parent(new, parent, true).unwrap();
    }

    fn change(&mut self) {
        let (object, other, alias) = (self.any(), self.any(), self.alias());
        let place = self.random.below(4) as i64 - 2;
        let scene = &mut self.scene;
        match self.random.below(8) {
            0 => drop(scene.set_parent(object, Some(other), true)),
            1 => drop(scene.set_parent(object, None, true)),
            2 => drop(scene.set_hierarchy_order(object, place)),
            3 => scene.set_alias(object, alias.as_bytes()).unwrap(),
            4 if scene.len() > 10 => scene.remove(&[object]).unwrap(),
            4 if object != other => scene.remove(&[object, other]).unwrap(),
            5 if scene.len() < 30 => {
                let originals = scene.subtree(object);
                let options = crate::CopyOptions::empty();
                scene.copy_objects(&originals, options).unwrap();
            }
            _ if scene.len() < 40 => self.add(),
            _ => {}
        }
    }

    fn component(&mut self) -> Component {
        let pattern = ["a", "b", "ab", "ba", "a*", "?", "*", "c"][self.random.below(8)];
        let sibling = (self.random.below(3) == 0).then(|| self.random.below(3));
        Component::new(pattern, sibling)
    }

    /// Looks for random paths, and compares with what is found by looking at everything.
    fn check_search(&mut self) {
        let components: Vec<Component> = (0..1 + self.random.below(3))
            .map(|_| self.component())
            .collect();
        let base = (self.random.below(3) == 0).then(|| self.any());
        let expected = all_matches(&self.scene, base, &components);
        for nth in 0..expected.len() + 2 {
            let found = Search::new(&self.scene).run(base, &components, &mut { nth });
            assert_eq!(found, expected.get(nth).copied(), "{components:?} {nth}");
        }
    }

    fn check_siblings(&self) {
        for object in self.scene.objects() {
            let siblings = self.scene.siblings(object.handle()).unwrap();
            let place = siblings
                .iter()
                .position(|&sibling| sibling == object.handle());
            assert_eq!(self.scene.place_among_siblings(object.handle()).ok(), place);
            let is_namesake =
                |sibling: &&Handle| self.scene.object(**sibling).unwrap().alias() == object.alias();
            let namesakes: Vec<&Handle> = siblings.iter().filter(is_namesake).collect();
            let order = namesakes
                .iter()
                .position(|&&sibling| sibling == object.handle());
            let order = order.filter(|_| namesakes.len() > 1);
            assert_eq!(self.scene.child_order(object.handle()), Ok(order));
        }
    }
}

/// All that a path leads to: of each object all children first, then what is below the first child, and so on.
fn all_matches(scene: &Scene, base: Option<Handle>, components: &[Component]) -> Vec<Handle> {
    let (first, rest) = components.split_first().unwrap();
    let is_match =
        |object: &Object| wildcard_match(first.pattern.as_bytes(), object.alias().as_bytes());
    let (mut found, mut pending) = (Vec::new(), vec![base]);
    while let Some(base) = pending.pop() {
        let children = scene
            .children_of(base)
            .iter()
            .map(|&child| scene.object(child).unwrap());
        let (matching, others): (Vec<_>, Vec<_>) =
            children.clone().partition(|child| is_match(child));
        let chosen = matching.iter().enumerate();
        let chosen =
            chosen.filter(|(number, _)| first.sibling.is_none_or(|wanted| wanted == *number));
        for (_, object) in chosen {
            match rest {
                [] => found.push(object.handle()),
                rest => found.extend(all_matches(scene, Some(object.handle()), rest)),
            }
        }
        let deeper: Vec<_> = match first.sibling {
            None => children.collect(),
            Some(_) => others,
        };
        pending.extend(deeper.iter().rev().map(|object| Some(object.handle())));
    }
    found
}

#[test]
fn what_is_found_is_what_a_look_at_everything_finds() {
    for seed in 0..20 {
        let (scene, random) = (Scene::new(), Random::new(seed));
        let mut trees = Trees { scene, random };
        (0..20).for_each(|_| trees.add());
        for _ in 0..60 {
            trees.change();
            trees.check_siblings();
            trees.check_search();
        }
    }
}

#[test]
fn an_alias_is_found_without_looking_at_other_objects() {
    let mut scene = Scene::new();
    let mut parent = None;
    for number in 0..100 {
        let siblings = [(); 3].map(|()| {
            let dummy = Kind::Dummy(Dummy::new(0.01));
            let dummy = scene.add(&format!("d{number}"), dummy).unwrap();
            scene.set_parent(dummy, parent, true).unwrap();
            dummy
        });
        parent = Some(siblings[1]);
    }
    for (alias, sibling) in [
        ("d0", None),
        ("d7", Some(1)),
        ("d99", None),
        ("missing", None),
    ] {
        let mut search = Search::new(&scene);
        search.run(None, &[Component::new(alias, sibling)], &mut 0);
        assert!(search.lists <= 1, "{alias}: {}", search.lists);
    }
}

#[test]
fn places_in_a_list_are_known_however_often_its_order_changes() {
    let mut scene = Scene::new();
    let all: Vec<Handle> = (0..5)
        .map(|_| scene.add("d", Kind::Dummy(Dummy::new(0.01))).unwrap())
        .collect();
    // There is only so much room between the ranks of two siblings.
    for number in 0..500 {
        scene.set_hierarchy_order(all[number % 5], 2).unwrap();
        assert_eq!(scene.place_among_siblings(all[number % 5]), Ok(2));
        let places = scene.roots().iter().map(|&h| scene.child_order(h).unwrap());
        assert!(places.eq((0..5).map(Some)));
    }
}
