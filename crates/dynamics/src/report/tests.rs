//! Force sensors: filters, thresholds, violations in a row.

use super::*;

/// A force along x, N, and a torque about z, N m.
fn load(force: f64, torque: f64) -> Load {
    ([force, 0.0, 0.0], [0.0, 0.0, torque])
}

fn sensor(change: impl FnOnce(&mut ForceSensor)) -> ForceSensor {
    let mut sensor = ForceSensor::default();
    change(&mut sensor);
    sensor
}

/// What the filter shows after each of these forces.
fn filtered(sensor: &mut ForceSensor, forces: &[f64]) -> Vec<Option<f64>> {
    let mut show = |&force: &f64| {
        take_sample(sensor, load(force, 2.0 * force));
        sensor.filtered.map(|(force, torque)| {
            assert_eq!(torque, [0.0, 0.0, 2.0 * force[0]]);
            force[0]
        })
    };
    forces.iter().map(&mut show).collect()
}

#[test]
fn the_mean_is_that_of_the_last_values() {
    let mut sensor = sensor(|sensor| sensor.sample_size = 3);
    let shown = filtered(&mut sensor, &[1.0, 2.0, 6.0, 10.0, 11.0]);
    assert_eq!(shown, [None, None, Some(3.0), Some(6.0), Some(9.0)]);
    assert_eq!(sensor.samples.len(), 3);
}

#[test]
fn the_median_is_the_middle_of_each_component() {
    let mut sensor = sensor(|sensor| {
        (sensor.sample_size, sensor.filter) = (4, ForceFilter::Median);
    });
    // Of 1, 5, 7, 100 the element number 2; then of 2, 5, 7, 100.
    let shown = filtered(&mut sensor, &[100.0, 1.0, 7.0, 5.0, 2.0, 50.0, 0.0]);
    assert_eq!(shown[3..], [Some(7.0), Some(5.0), Some(7.0), Some(5.0)]);
}

/// Which of these loads make the sensor trigger.
fn triggering(sensor: &mut ForceSensor, loads: &[(f64, f64)]) -> Vec<bool> {
    let mut triggers = |&(force, torque): &(f64, f64)| {
        let fired = take_sample(sensor, load(force, torque));
        assert!(fired.is_none_or(|fired| fired == load(force, torque)));
        fired.is_some()
    };
    loads.iter().map(&mut triggers).collect()
}

#[test]
fn violations_in_a_row_trigger_and_are_counted_anew() {
    let mut sensor = sensor(|sensor| {
        (sensor.force_threshold_enabled, sensor.force_threshold) = (true, 5.0);
        (sensor.torque_threshold_enabled, sensor.torque_threshold) = (true, 2.0);
        sensor.consecutive_violations = 2;
    });
    let loads = [
        (5.0, 0.0),
        (0.0, -2.0),
        (-6.0, 0.0),
        (4.9, 1.9),
        (6.0, 0.0),
        (6.0, 0.0),
    ];
    let expected = [false, true, false, false, false, true];
    assert_eq!(triggering(&mut sensor, &loads), expected);
}

#[test]
fn thresholds_count_when_they_are_on() {
    let large = [(1e3, 1e3)];
    for (force, torque) in [(false, false), (true, false), (false, true)] {
        let mut sensor = sensor(|sensor| {
            sensor.force_threshold_enabled = force;
            sensor.torque_threshold_enabled = torque;
            sensor.consecutive_violations = 0;
        });
        assert_eq!(triggering(&mut sensor, &large), [force || torque]);
    }
    // A length, not a component.
    let mut sensor = sensor(|sensor| {
        (sensor.force_threshold_enabled, sensor.force_threshold) = (true, 5.0);
        sensor.consecutive_violations = 1;
    });
    let slanted = ([3.0, 0.0, 4.0], [0.0; 3]);
    assert_eq!(take_sample(&mut sensor, slanted), Some(slanted));
}
