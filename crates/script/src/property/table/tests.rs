//! The table of properties, its accessors and its names agree.

use super::{
    LaterName, ValueSource, accessors, app_class, classes, flags, later_names, lines, parts,
};

#[test]
fn every_accessor_has_its_row() {
    let parts = parts();
    for (part, name) in accessors().keys() {
        let row = parts[part].iter().find(|row| row.name == *name);
        assert!(
            row.is_some_and(|row| matches!(row.source, ValueSource::Works(_))),
            "{part}: {name}"
        );
    }
}

#[test]
fn every_line_says_what_becomes_of_it() {
    assert!(lines().all(|line| ["works", "inert", "constant"].contains(&line.state)));
}

#[test]
fn what_works_works_in_every_direction_it_is_said_to() {
    for (part, row) in parts()
        .iter()
        .flat_map(|(part, rows)| rows.iter().map(move |row| (part, row)))
    {
        let ValueSource::Works(accessor) = row.source else {
            continue;
        };
        assert!(
            accessor.read.is_some() || row.flags & flags::NOT_READABLE != 0,
            "{part}: {} is read",
            row.name
        );
        assert!(
            accessor.write.is_some() || row.flags & flags::NOT_WRITABLE != 0,
            "{part}: {} is written",
            row.name
        );
    }
}

#[test]
fn later_names_mean_the_same_rows() {
    let mut found = 0;
    for LaterName {
        class: word,
        name,
        later,
        is_opposite,
    } in later_names()
    {
        let with_both = classes().iter().filter(|class| {
            let (before, after) = class.rows();
            let mut rows = before.iter().chain(after);
            rows.any(|row| row.name == name && row.class.ends_with(word))
        });
        for class in with_both {
            let row = class.find(later).expect(later);
            let meant = match &row.source {
                ValueSource::Opposite(of) if is_opposite => of.name,
                _ => row.name,
            };
            assert_eq!(meant, name, "{later}");
            found += 1;
        }
    }
    assert!(found > 90, "{found}");
    let joint = classes().iter().find(|class| class.word == "joint");
    let bounce = joint.and_then(|class| class.find("dynamics.ode.bounce"));
    assert_eq!(bounce.map(|row| row.name), Some("ode.bounce"));
}

#[test]
fn rows_are_found_by_name() {
    for class in classes() {
        let (before, after) = class.rows();
        for row in before.iter().chain(after) {
            assert_eq!(
                class.find(row.name).map(|found| found.ty),
                Some(row.ty),
                "{}",
                row.name
            );
        }
    }
    assert_eq!(app_class().without_words("app.sessionId"), "sessionId");
}
