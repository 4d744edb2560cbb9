/** All tests in one process and one browser: starting it takes longer than most of them. */
import "./accessible.test.js";
import "./curves.test.js";
import "./data.test.js";
import "./opening.test.js";
import "./planes.test.js";
import "./print.test.js";
import "./robust.test.js";
import "./texts.test.js";
