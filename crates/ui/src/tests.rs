//! Windows from texts, inputs, and what pages get.

use std::collections::BTreeMap;

use serde_json::json;

use super::*;

fn opened(content: &str) -> (Ui, String) {
    let mut ui = Ui::default();
    let text = format!("<ui title=\"Panel\" closeable=\"true\" on-close=\"closed\">{content}</ui>");
    let (handle, warnings) = ui
        .create(&text, 7, BTreeMap::new())
        .expect("the text is right");
    assert!(warnings.is_empty(), "{warnings:?}");
    (ui, handle)
}

fn wrong(text: &str) -> String {
    let mut ui = Ui::default();
    let error = ui
        .create(text, 7, BTreeMap::new())
        .expect_err("the text is wrong")
        .to_string();
    assert!(ui.windows().next().is_none());
    error
}

/// The events that wait, as function and arguments after window and widget.
fn events(ui: &mut Ui) -> Vec<(String, Vec<Data>)> {
    let mut all = Vec::new();
    while let Some(event) = ui.next_event() {
        let event = event.expect("its widget exists");
        assert_eq!(event.script, 7);
        all.push((event.handler, event.args[1..].to_vec()));
    }
    all
}

fn input(ui: &mut Ui, window: &str, mut fields: Value) -> Result<(), String> {
    fields["window"] = window.into();
    ui.input(&fields)
}

#[test]
fn mistakes_in_texts_name_the_elements_around_them() {
    for (text, error) in [
        ("<ui", "XML parse error"),
        ("", "XML parse error"),
        ("<window/>", "root element must be <ui>"),
        ("<ui><foo/></ui>", "invalid element <foo>"),
        (
            "<ui><group><foo/></group></ui>",
            "group: invalid element <foo>",
        ),
        ("<ui><tab/></ui>", "invalid element <tab>"),
        ("<ui><br/></ui>", "invalid element <br>"),
        (
            "<ui layout='grid'><stretch/></ui>",
            "stretch must be placed in a widget with vbox/hbox layout",
        ),
        (
            "<ui><tabs id='7'><button/></tabs></ui>",
            "tabs[id=7]: element must be <tab>",
        ),
        (
            "<ui><button id='1'/><label id='1'/></ui>",
            "label[id=1]: id must be unique (within ui scope). duplicate id: 1",
        ),
        (
            "<ui><button id='0'/></ui>",
            "button: id must be a positive integer",
        ),
        (
            "<ui><tabs id='7'><tab><button id='3' enabled='1'/></tab></tabs></ui>",
            "tabs[id=7]: tab: button[id=3]: invalid value '1' for attribute 'enabled': must be true or false",
        ),
        (
            "<ui layout='form'><label/></ui>",
            "extra elements in layout",
        ),
        (
            "<ui position='1'/>",
            "attribute 'position' must have exactly 2 elements",
        ),
        (
            "<ui><label geometry='1,2,3,4'/></ui>",
            "label: cannot set geometry with current layout",
        ),
    ] {
        assert_eq!(wrong(text), error, "{text}");
    }
    let cast = "bad lexical cast: source type value could not be interpreted as target";
    for text in [
        "<ui position='50, 50'/>",
        "<ui><button id='x'/></ui>",
        "<ui><hslider value='1.5'/></ui>",
    ] {
        assert!(wrong(text).ends_with(cast), "{text}");
    }
    let modes = wrong("<ui><table selection-mode='rows'/></ui>");
    assert!(
        modes.ends_with("(must be one of: 'item', 'row', 'column')"),
        "{modes}"
    );
}

#[test]
fn old_names_of_attributes_are_warned_of_once() {
    let mut ui = Ui::default();
    let mut warnings = |text: &str| {
        ui.create(text, 1, BTreeMap::new())
            .expect("the text is right")
            .1
    };
    let text = "<ui onclose='x'><button onclick='f' colour='red'/></ui>";
    assert_eq!(
        warnings(text),
        [
            "attribute name 'onclose' is deprecated. please use 'on-close' instead.",
            "attribute name 'onclick' is deprecated. please use 'on-click' instead.",
            "unknown UI XML attribute 'colour' in widget 'button'",
        ]
    );
    assert_eq!(
        warnings(text),
        ["unknown UI XML attribute 'colour' in widget 'button'"]
    );
}

#[test]
fn values_are_clamped_and_rounded() {
    let (mut ui, window) = opened(
        "<hslider id='1' minimum='-5' maximum='5'/><spinbox id='2' value='3.7'/>\
         <spinbox id='3' decimals='2' value='1.236'/><spinbox id='4' step='0.5'/>",
    );
    let value = |ui: &Ui, id| ui.window(&window).unwrap().value(id).unwrap();
    assert_eq!(
        [value(&ui, 2), value(&ui, 3)],
        [Data::Int(3), Data::Float(1.24)]
    );
    ui.change(&window, |window| {
        window.set_slider(1, 99, false)?;
        window.set_spinbox(4, 2.25, false)?;
        window.set_spinbox(2, f64::NAN, false)
    })
    .unwrap();
    assert_eq!(
        [value(&ui, 1), value(&ui, 4), value(&ui, 2)],
        [Data::Int(5), Data::Float(2.25), Data::Int(0)]
    );
}

#[test]
fn inputs_change_values_and_queue_events() {
    let (mut ui, window) = opened(
        "<button id='1' text='Go' on-click='go'/><hslider id='2' on-change='slid'/>\
         <radiobutton id='3' checked='true' on-click='chosen'/><radiobutton id='4' on-click='chosen'/>\
         <combobox id='5' on-change='picked'><item>a</item><item>b</item></combobox>\
         <edit id='6' on-change='typed' on-editing-finished='entered'/><checkbox id='8' on-change='ticked'/>",
    );
    for fields in [
        json!({"type": "click", "widget": 1}),
        json!({"type": "value", "widget": 2, "value": 250}),
        json!({"type": "value", "widget": 2, "value": 100}),
        json!({"type": "click", "widget": 4}),
        json!({"type": "value", "widget": 5, "value": "b"}),
        json!({"type": "value", "widget": 6, "value": "x"}),
        json!({"type": "finish", "widget": 6}),
        json!({"type": "click", "widget": 8}),
        json!({"type": "close"}),
    ] {
        input(&mut ui, &window, fields.clone()).unwrap_or_else(|error| panic!("{fields}: {error}"));
    }
    let radio = |id| ui.window(&window).unwrap().value(id).unwrap();
    assert_eq!([radio(3), radio(4)], [Data::Int(0), Data::Int(1)]);
    let expected = [
        ("go", vec![Data::Int(1)]),
        ("slid", vec![Data::Int(2), Data::Int(100)]),
        ("chosen", vec![Data::Int(4)]),
        ("picked", vec![Data::Int(5), Data::Int(1)]),
        ("typed", vec![Data::Int(6), Data::text("x")]),
        ("entered", vec![Data::Int(6), Data::text("x")]),
        ("ticked", vec![Data::Int(8), Data::Int(2)]),
        ("closed", vec![]),
    ];
    assert_eq!(
        events(&mut ui),
        expected.map(|(handler, args)| (handler.to_owned(), args))
    );
}

#[test]
fn what_takes_no_inputs_refuses_them() {
    let (mut ui, window) = opened(
        "<button id='1' enabled='false' on-click='go'/><group visible='false'><button id='2' on-click='go'/></group>\
         <label id='3'/><table id='4' editable='false'><row><item/></row></table>",
    );
    for (fields, error) in [
        (
            json!({"type": "click", "widget": 1}),
            "widget 1 is disabled",
        ),
        (
            json!({"type": "click", "widget": 2}),
            "widget 2 is not visible",
        ),
        (
            json!({"type": "click", "widget": 3}),
            "label 3 does not take this input",
        ),
        (
            json!({"type": "cell", "widget": 4, "row": 0, "column": 0, "text": "x"}),
            "cell 0, 0 of table 4 cannot be changed",
        ),
        (
            json!({"type": "cell", "widget": 4, "row": 9, "column": 0}),
            "table 4 has no cell 9, 0",
        ),
        (
            json!({"type": "click", "widget": 99}),
            "invalid widget id: 99",
        ),
        (json!({"type": "click"}), "the field 'widget' is missing"),
        (
            json!({"type": "dance", "widget": 1}),
            "there is no input of type 'dance'",
        ),
        (json!([]), "the field 'type' is missing"),
    ] {
        let outcome = if fields.is_object() {
            input(&mut ui, &window, fields)
        } else {
            ui.input(&fields)
        };
        assert_eq!(outcome, Err(error.to_owned()));
    }
    assert!(events(&mut ui).is_empty());
    let modal = "<ui modal='true' title='First me'/>";
    ui.create(modal, 7, BTreeMap::new()).unwrap();
    let refused = input(&mut ui, &window, json!({"type": "close"}));
    assert_eq!(
        refused,
        Err("window 'Panel' waits for 'First me'".to_owned())
    );
}

#[test]
fn pages_get_what_has_changed() {
    let (mut ui, window) = opened("<label id='1' text='a'/>");
    let (other, _) = ui
        .create("<ui title='Other'/>", 7, BTreeMap::new())
        .unwrap();
    let snapshot = ui.snapshot();
    let seen = snapshot["revision"].as_u64().unwrap();
    assert_eq!(snapshot["windows"][0]["content"]["items"][0]["text"], "a");
    assert_eq!(ui.changes_since(seen), None);
    ui.change(&window, |window| window.set_label(1, "b".into()))
        .unwrap();
    let changes = ui.changes_since(seen).unwrap();
    assert_eq!(changes["windows"].as_array().unwrap().len(), 1);
    assert_eq!(changes["windows"][0]["content"]["items"][0]["text"], "b");
    ui.destroy(&other).unwrap();
    assert_eq!(ui.changes_since(seen).unwrap()["removed"], json!([other]));
    for _ in 0..2 * MAX_REMOVED {
        let (handle, _) = ui.create("<ui/>", 7, BTreeMap::new()).unwrap();
        ui.destroy(&handle).unwrap();
    }
    let changes = ui.changes_since(seen).unwrap();
    assert_eq!(
        (
            &changes["complete"],
            changes["windows"].as_array().unwrap().len()
        ),
        (&json!(true), 1)
    );
}

#[test]
fn curves_keep_as_many_points_as_their_buffers() {
    for (cyclic, expected) in [
        ("false", vec![1.0, 2.0, 3.0]),
        ("true", vec![4.0, 5.0, 6.0]),
    ] {
        let (mut ui, window) = opened(&format!(
            "<plot id='1' max-buffer-size='3' cyclic-buffer='{cyclic}'/>"
        ));
        ui.change(&window, |window| {
            let plot = window.get_mut::<Plot>(1)?;
            let options = CurveOptions::default();
            let curve = Curve {
                name: "a".into(),
                curve_type: CurveType::Time,
                color: [0; 3],
                style: 0,
                options,
                points: vec![],
            };
            plot.add_curve(curve.clone())?;
            assert!(plot.add_curve(curve).is_err());
            for x in [vec![2.0, 1.0, 3.0, 5.0, 4.0], vec![6.0]] {
                plot.add_points("a", CurveType::Time, x.into_iter().map(|x| [x, x, 0.0]))?;
            }
            let found: Vec<f64> = plot
                .curve("a")?
                .points
                .iter()
                .map(|point| point[1])
                .collect();
            assert_eq!(found, expected);
            plot.rescale(None, [false; 2])
        })
        .unwrap();
    }
}

#[test]
fn trees_have_no_loops() {
    let (mut ui, window) = opened(
        "<tree id='1'><row id='2' parent-id='1'/><row id='1'/><row id='3' parent-id='9'/><row id='4' parent-id='2'/></tree>",
    );
    ui.change(&window, |window| {
        let tree = window.get_mut::<Tree>(1)?;
        assert_eq!(tree.items.keys().copied().collect::<Vec<_>>(), [1, 2, 4]);
        tree.move_item(2, 4);
        assert_eq!(tree.items[&2].parent, 1);
        tree.add(1, 4, Vec::new(), false);
        assert_eq!(tree.items[&1].parent, 0);
        tree.remove(1);
        assert!(tree.items.is_empty());
        Ok(())
    })
    .unwrap();
}

#[test]
fn tables_may_be_large_and_open_lines_keep_texts() {
    let (mut ui, window) = opened(
        "<table id='1'><row><item>a</item></row><row><item>b</item><item>c</item></row></table>",
    );
    ui.change(&window, |window| {
        let table = window.get_mut::<Table>(1)?;
        assert_eq!(
            (
                table.row_count,
                table.column_count,
                table.text(1, 1),
                table.text(9, 9)
            ),
            (2, 2, "c", "")
        );
        table.insert_row(1);
        assert_eq!(
            [table.text(0, 0), table.text(1, 0), table.text(2, 0)],
            ["a", "b", "b"]
        );
        table.remove_column(0);
        assert_eq!([table.text(1, 0), table.text(2, 0)], ["c", "c"]);
        table.resize(i64::MAX, i64::MAX);
        assert!(!table.set_text(-1, 0, "x".into()));
        Ok(())
    })
    .unwrap();
    assert_eq!(
        ui.snapshot()["windows"][0]["content"]["items"][0]["rowCount"],
        json!(i64::MAX)
    );
}

#[test]
fn images_are_turned_upside_down() {
    let (mut ui, window) = opened("<image id='1' width='2' height='1'/>");
    ui.change(&window, |window| {
        let image = window.get_mut::<Image>(1)?;
        assert_eq!(image.pixels, [0; 8]);
        let wrong = image.set_rgb(b"123", 2, 2).unwrap_err().to_string();
        assert_eq!(wrong, "bad image size. expected: 12. got: 3.");
        assert!(image.set_rgb(b"", i64::MAX, i64::MAX).is_err());
        image.set_rgb(&[1, 2, 3, 4, 5, 6], 1, 2)?;
        assert_eq!(image.pixels, [4, 5, 6, 255, 1, 2, 3, 255]);
        image.set_rgb(b"", 0, 5)
    })
    .unwrap();
}

#[test]
fn widgets_are_found_by_what_a_person_sees() {
    let mut ui = Ui::default();
    let text = "<ui title='Robot' layout='form'><label text='Speed:'/><hslider id='5' on-change='setSpeed'/>\
                <button id='9' text='Start'/><edit id='3'/></ui>";
    let names = BTreeMap::from([("entry".to_owned(), 3), ("other".to_owned(), 44)]);
    ui.create(text, 7, names).unwrap();
    let window = ui.window(&ui.find_window("Robot").unwrap()).unwrap();
    for (name, id) in [
        ("Speed", 5),
        ("setSpeed", 5),
        ("5", 5),
        ("Start", 9),
        ("entry", 3),
    ] {
        assert_eq!(window.find_widget(name), Ok(id), "{name}");
    }
    assert_eq!(
        window.find_widget("Stop"),
        Err("window 'Robot' has no widget 'Stop'; it has: label 'Speed', hslider 5, button 'Start', edit 'entry'."
            .into())
    );
    assert_eq!(
        ui.find_window("Arm"),
        Err("there is no window 'Arm'; there are: 'Robot'.".into())
    );
}

#[test]
fn events_of_what_is_gone_are_dropped() {
    let (mut ui, window) = opened("<button id='1' on-click='go'/>");
    input(&mut ui, &window, json!({"type": "click", "widget": 1})).unwrap();
    ui.destroy(&window).unwrap();
    assert!(matches!(ui.next_event(), Some(Err(_))));
    assert!(matches!(ui.window(&window), Err(UiError::NoSuchWindow)));
    for handle in ["", "1", ":UI", "01:UI", "+1:UI", "1:ui"] {
        assert!(ui.window(handle).is_err(), "{handle}");
    }
}
