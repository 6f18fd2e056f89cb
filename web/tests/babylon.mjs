// Babylon.js in Chromium: what its loader makes of compressed files is what it makes of plain ones.
//
//   node babylon.mjs TUTTE BUILD_FOLDER
import {testLoaderPage} from './loader_page.mjs';

testLoaderPage('babylonjs', 'babylon.html');
