//! Path planning tasks of V-REP: global functions (spec: vrep-era 2.3). Files with such tasks are loaded without them, so there is none.

use api_macro::api;

use crate::{ApiError, ApiFn, Cx, Result, functions};
use script::{Number, Rest};

pub(crate) const FUNCTIONS: &[ApiFn] = functions![
    sim_get_path_planning_handle,
    sim_search_path,
    sim_initialize_path_search,
    sim_perform_path_search_step,
];

fn no_such_task<T>() -> Result<T> {
    Err(ApiError::Other(
        "path planning object does not exist.".into(),
    ))
}

/// A path planning task of V-REP; none is kept.
///
/// @param pathPlanningObjectName its name
/// @return pathPlanningObjectHandle
#[api("simGetPathPlanningHandle")]
fn sim_get_path_planning_handle(_cx: &Cx, path_planning_object_name: String) -> Result<i64> {
    let _ = path_planning_object_name;
    no_such_task()
}

/// Plans a path; there are no tasks.
///
/// @param pathPlanningObjectHandle the task
/// @param maximumSearchTime seconds
/// @return result
#[api("simSearchPath")]
fn sim_search_path(
    _cx: &Cx,
    path_planning_object_handle: Number,
    maximum_search_time: f64,
) -> Result<i64> {
    let _ = (path_planning_object_handle, maximum_search_time);
    no_such_task()
}

/// Begins to plan a path; there are no tasks.
///
/// @param pathPlanningObjectHandle the task
/// @param maximumSearchTime seconds
/// @param searchTimeStep seconds
/// @return temporaryPathSearchObject
#[api("simInitializePathSearch")]
fn sim_initialize_path_search(
    _cx: &Cx,
    path_planning_object_handle: Number,
    maximum_search_time: f64,
    search_time_step: f64,
) -> Result<i64> {
    let _ = (
        path_planning_object_handle,
        maximum_search_time,
        search_time_step,
    );
    no_such_task()
}

/// Goes on planning a path; there are no tasks.
///
/// @param temporaryPathSearchObject from simInitializePathSearch
/// @return result
#[api("simPerformPathSearchStep")]
fn sim_perform_path_search_step(
    _cx: &Cx,
    temporary_path_search_object: Number,
    #[name("...")] further: Rest,
) -> Result<i64> {
    let _ = (temporary_path_search_object, further);
    no_such_task()
}
