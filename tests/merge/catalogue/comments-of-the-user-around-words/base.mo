model A
 A a (x = 1) ;
end A;
