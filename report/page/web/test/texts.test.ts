import assert from "node:assert/strict";
import { test } from "node:test";

import { leadingNumber, numberText, quantityText } from "../src/axes/number_text.js";
import { decadeText, linearTicks, logTicks } from "../src/axes/ticks.js";
import { csv } from "../src/document/csv.js";
import { compareCells } from "../src/page/cells.js";
import { linearMap, signedLogMap } from "../src/plane/axis_map.js";
import { hubZeros_rad_per_s, kPaperArm, modes } from "./samples/arm.js";

const texts = (ticks: { text: string }[]) => ticks.map((tick) => tick.text);

test("numbers have four digits and a minus sign", () => {
  assert.equal(numberText(1234.567), "1235");
  assert.equal(numberText(-0.0123456), "−0.01235");
  assert.equal(numberText(4.3e-7), "4.3e−7");
  assert.equal(numberText(-1.23456e9), "−1.235e9");
  assert.equal(numberText(NaN), "–");
  assert.equal(numberText(-Infinity), "−∞");
  assert.equal(quantityText(0.5, "kg"), "0.5 kg");
  assert.equal(quantityText(0.5, ""), "0.5");
});

test("numbers in texts are read for sorting", () => {
  assert.equal(leadingNumber("60.5 %"), 60.5);
  assert.equal(leadingNumber("−1.2e−5 ± 0.1"), -1.2e-5);
  assert.equal(leadingNumber("< 0.01"), 0.01);
  assert.equal(leadingNumber("∞"), Infinity);
  assert.ok(Number.isNaN(leadingNumber("–")));
  assert.deepEqual(["10", "–", "9", "-1"].sort((a, b) => compareCells(a, b, true)), ["-1", "9", "10", "–"]);
  assert.deepEqual(["run 10", "run 9"].sort((a, b) => compareCells(a, b, false)), ["run 9", "run 10"]);
});

test("linear ticks are at multiples of 1, 2 or 5, degrees at those of 90", () => {
  assert.deepEqual(texts(linearTicks(-0.25, 0.3, 6)), ["−0.2", "−0.1", "0", "0.1", "0.2", "0.3"]);
  assert.deepEqual(texts(linearTicks(0.9996, 1.0004, 5)), ["0.9996", "0.9998", "1", "1.0002", "1.0004"]);
  assert.deepEqual(texts(linearTicks(-360, 0, 5, "deg")), ["−360", "−270", "−180", "−90", "0"]);
  assert.deepEqual(linearTicks(1, 1, 5), []);
});

test("logarithmic ticks are decades, with 2 and 5 where there is room, linear within one", () => {
  const named = (least: number, greatest: number, most: number) =>
    texts(logTicks(least, greatest, most)).filter((text) => text !== "");
  assert.deepEqual(named(0.5, 80, 11), ["0.5", "1", "2", "5", "10", "20", "50"]);
  assert.deepEqual(named(1e-6, 1e6, 4), ["10⁻⁶", "0.001", "1", "1000", "10⁶"]);
  assert.deepEqual(named(11, 13, 5), ["11", "11.5", "12", "12.5", "13"]);
  assert.deepEqual(logTicks(-1, 1, 5), []);
  assert.equal(decadeText(2, -7), "2·10⁻⁷");
});

test("the signed logarithm is odd, keeps order and comes back", () => {
  const map = signedLogMap([-300, -57, 0, 57, 2]);
  const values = [-300, -57, -2, 0, 2, 57, 300];
  const distances = values.map(map.forward);
  assert.ok(distances.every((d, i) => i === 0 || d > distances[i - 1]!));
  values.forEach((value, i) => assert.ok(Math.abs(map.inverse(distances[i]!) - value) < 1e-9));
  assert.equal(distances[3], 0);
  assert.equal(distances[0], -distances[6]!);
  assert.deepEqual(texts(map.ticks(distances[0]!, distances[6]!, 8)), ["0", "10", "−10", "100", "−100"]);
});

test("one step serves both axes of equal scales", () => {
  const map = linearMap({ label: "", unit: "", scale: "linear" });
  assert.deepEqual(texts(map.ticks(-1, 1, 2, 0.5)), ["−1", "−0.5", "0", "0.5", "1"]);
});

test("CSV quotes what has to be, and leaves gaps empty", () => {
  const cells = [["a,b", NaN], ['say "x"', 0.1]] as const;
  const table = {
    columns: [
      { title: "name", unit: "", numeric: false },
      { title: "y", unit: "m/s²", numeric: true, digits: 7 },
    ],
    rowCount: 2,
    cell: (row: number, column: number) => cells[row]![column]!,
  };
  assert.equal(csv(table), 'name,y [m/s²]\r\n"a,b",\r\n"say ""x""",0.1\r\n');
});

// 30 digits are in tests/reference/exact.json; the samples are drawn, so three digits do.
test("the sample arm has the poles and zeros of the paper's", () => {
  const hz = (omega: number) => omega / (2 * Math.PI);
  const poles = modes(kPaperArm, 3).map((mode) => hz(mode.omega_rad_per_s));
  [11.8618, 32.2606, 58.5327].forEach((pole, i) => assert.ok(Math.abs(poles[i]! - pole) < 1e-3, String(poles)));
  const zeros = hubZeros_rad_per_s(kPaperArm, 2).map(hz);
  [2.87337, 18.0071].forEach((zero, i) => assert.ok(Math.abs(zeros[i]! - zero) < 1e-3, String(zeros)));
});
